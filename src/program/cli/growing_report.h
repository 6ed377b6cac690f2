// A report that grows: what is known so far is in its file, whole, so that a process that is killed leaves
// it.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

#include "ringlet/base/result.h"

namespace ringlet::program {

class GrowingReport {
 public:
  /// Empty: there is no file. Where the path is a pipe or a device it gets what finish is given, and no more.
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
