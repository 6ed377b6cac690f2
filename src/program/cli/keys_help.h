// What the keys of a report mean, for a command's --help.
#pragma once

#include <string>
#include <vector>

#include "ringlet/run/run_report.h"

namespace ringlet::program {

/// HEADING, and a line a key: its name, a sentence, its unit. An object's own keys stand below it, indented;
/// where another object has the same ones, its line names the first.
std::string keysHelp(const std::vector<ReportKey>& keys, const std::string& heading = "--json keys:");

}  // namespace ringlet::program
