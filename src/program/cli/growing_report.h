// A report that is rewritten as results arrive, as a whole file each time, so that a killed process leaves
// what was known.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

#include "ringlet/base/result.h"

namespace ringlet::program {

class GrowingReport {
 public:
  /// Empty path: no file is written. A pipe or a device only gets the final report, by finish.
  explicit GrowingReport(std::filesystem::path path);

  bool isThere() const { return !path_.empty(); }
  /// Replaces the file as a whole. Errors: as for writeWholeFile.
  Status grow(const nlohmann::ordered_json& json) const;
  Status finish(const nlohmann::ordered_json& json) const;

 private:
  std::filesystem::path path_;
  bool isReplaced_ = true;
};

}  // namespace ringlet::program
