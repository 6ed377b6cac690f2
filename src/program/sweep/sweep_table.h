// The table of a sweep, a line for each run, as text, CSV and JSON.
#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>

#include "program/sweep/sweep_run.h"

namespace ringlet::program {

/// Keys: runs; for each run state, exit_status, values {key: value}, and the table's numbers if it is
/// finished, or error if it failed.
nlohmann::ordered_json sweepJson(std::span<const SweepEntry> entries, std::span<const SweepAxis> axes,
                                 const SweepOptions& options);

/// A column for each key, with the names of the JSON.
std::string sweepCsv(std::span<const SweepEntry> entries, std::span<const SweepAxis> axes,
                     const SweepOptions& options);

/// For people: aligned columns, with the values that vary.
std::string sweepText(std::span<const SweepEntry> entries, std::span<const SweepAxis> axes,
                      const SweepOptions& options);

}  // namespace ringlet::program
