// The outcome of a run as one JSON object, as a few lines of text, and as sentences on standard error. All
// commands that step hair use it, so that a key has the same meaning everywhere.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "ringlet/run/run_report.h"
#include "ringlet/scene/settings.h"

namespace ringlet::program {

/// runReport, to be added to.
nlohmann::ordered_json runJson(const RunNames& names, const Settings& settings, const RunOutcome& outcome);
std::string runText(const RunNames& names, const Settings& settings, const RunOutcome& outcome);

/// Prints warnings, lost particles and an interruption to standard error, as `ringlet COMMAND`, and returns
/// the exit status. frameCount: number of planned frames.
int tellTroubles(const char* command, const RunOutcome& outcome, int frameCount);

}  // namespace ringlet::program
