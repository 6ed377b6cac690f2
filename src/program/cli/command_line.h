// Shared by the subcommands: checks of options, with messages that say what is allowed.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "program/cli/cli_fwd.h"

namespace ringlet::program {

/// The name nearest to `word` (by insertions, deletions and replacements), or empty if none is near.
std::string closestName(std::string_view word, const std::vector<std::string>& names);

/// "; did you mean NAME?", or nothing if none is near.
std::string suggestion(std::string_view word, const std::vector<std::string>& names);

/// Accepts only these names; the message suggests the closest one.
CLI::Validator oneOf(std::vector<std::string> names);

/// Accepts finite numbers from low to high.
CLI::Validator between(double low, double high);
/// The same for integers.
CLI::Validator wholeBetween(std::int64_t low, std::int64_t high);

/// Accepts a path that ends in one of these extensions, in either case.
CLI::Validator endsIn(std::vector<std::string> extensions);

/// `--backend`, of commands that step hair, and `--device`, of all that use one.
CLI::Option* addBackendOption(CLI::App& command, std::string& backend);
CLI::Option* addDeviceOption(CLI::App& command, std::string& device);

/// Help of `--subgroup`, in simulate and scene.
inline constexpr const char* kSubgroupHelp =
    "Invocations of a subgroup of the strand kernel: one of the widths `ringlet devices` shows (default: "
    "chosen by device, or as `ringlet tune` measured)";

/// The message for a command line that CLI11 refused: the subcommand, what is wrong, the closest name.
std::string usageMessage(const CLI::App& app, const CLI::ParseError& error);

}  // namespace ringlet::program
