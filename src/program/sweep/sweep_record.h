// SweepRecord: the record that a finished run of a sweep leaves in its folder, run.json, so that the sweep
// need not repeat it.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/output/checkpoint_file.h"

namespace ringlet::program {

struct SweepRecord {
  std::vector<RunFact> facts;     // which identify the run
  nlohmann::ordered_json report;  // the keys of `ringlet simulate --json`, and those of sweeps
};

/// Replaces the file as a whole. Errors: those of writing a file.
Status writeRecord(const std::filesystem::path& path, const SweepRecord& record);

/// None if there is no file. Errors: it cannot be read, or is no record.
Result<std::optional<SweepRecord>> readRecord(const std::filesystem::path& path);

}  // namespace ringlet::program
