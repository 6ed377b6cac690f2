// What a run is told as: one JSON object, a few lines of text, sentences on standard error. Commands that
// step hair share it, so that the same key means the same everywhere.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "ringlet/run/run_report.h"
#include "ringlet/scene/settings.h"

namespace ringlet::program {

/// What the keys of --json mean, for --help.
std::string runKeysHelp();

/// runReport, to be added to.
nlohmann::ordered_json runJson(const RunNames& names, const Settings& settings, const RunOutcome& outcome);
std::string runText(const RunNames& names, const Settings& settings, const RunOutcome& outcome);

/// Prints warnings, lost particles and an interruption to standard error, as `ringlet COMMAND`, and returns
/// what the program is to return. frameCount: planned.
int tellTroubles(const char* command, const RunOutcome& outcome, int frameCount);

}  // namespace ringlet::program
