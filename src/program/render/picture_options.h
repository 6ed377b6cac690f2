// The options that commands which draw hair share.
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "program/cli/cli_fwd.h"

namespace ringlet::program {

/// "12:24" or "640x480": two whole numbers and what is between them; none where it is not that.
std::optional<std::pair<int, int>> parsePair(const std::string& text, char between);

/// Accepts such a text, of numbers from `least` to `most`.
CLI::Validator isPair(char between, int least, int most, const char* example);

/// `--samples` and `--colour`; `others`: names beside those of hair colours, separated by commas.
void addSamplesOption(CLI::App& command, int& samples);
void addColourOption(CLI::App& command, std::string& colour, const std::string& others = "");

}  // namespace ringlet::program
