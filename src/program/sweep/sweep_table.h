// The table of a sweep: a line a run, as text, CSV and JSON.
#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>

#include "program/sweep/sweep_run.h"

namespace ringlet::program {

/// Keys: runs, of each run state exit_status values {key: value} and, once it is finished, the numbers of
/// tables; error where it failed.
nlohmann::ordered_json sweepJson(std::span<const SweepEntry> entries, std::span<const SweepAxis> axes,
                                 const SweepOptions& options);

/// A column a key, with the names of JSON.
std::string sweepCsv(std::span<const SweepEntry> entries, std::span<const SweepAxis> axes,
                     const SweepOptions& options);

/// For a person: columns of equal width, values of what varies.
std::string sweepText(std::span<const SweepEntry> entries, std::span<const SweepAxis> axes,
                      const SweepOptions& options);

}  // namespace ringlet::program
