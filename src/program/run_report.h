// What a run is told as: one JSON object, a few lines of text, sentences on standard error. Commands that
// step hair share it, so that the same key means the same everywhere.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "program/simulate_run.h"
#include "ringlet/scene/settings.h"

namespace ringlet::program {

/// What the user chose, by the names it was typed with.
struct RunNames {
  std::string integrator = "jacobi", backend = "gpu", material = "default";
};

/// jacobi, point_jacobi, paper.
std::vector<std::string> integratorNames();
/// One of integratorNames().
Integrator integratorByName(const std::string& name);

nlohmann::ordered_json runJson(const RunNames& names, const Settings& settings,
                               const SimulateOutcome& outcome);
std::string runText(const RunNames& names, const Settings& settings, const SimulateOutcome& outcome);

/// Prints warnings, lost particles and an interruption to standard error, as `ringlet COMMAND`, and returns
/// what the program is to return. frameCount: planned.
int tellTroubles(const char* command, const SimulateOutcome& outcome, int frameCount);

/// Prints an object as the last thing on standard output. Not UTF-8, say in a path, is replaced rather than
/// fatal.
void printJson(const nlohmann::ordered_json& json);

}  // namespace ringlet::program
