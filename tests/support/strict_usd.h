// A reader of the .usda we write, strict about syntax, for tests only: it shares nothing with the writer.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "ringlet/base/vec3.h"

namespace ringlet::test {

struct UsdFile {
  std::map<std::string, std::string> metadata;  // of the file, e.g. upAxis -> "Y" with its quotes
  std::map<std::string, std::string> tokens;    // of the prim: type, wrap
  std::vector<int> counts;
  std::vector<float> widths;
  std::string widthInterpolation;
  std::map<double, std::vector<Vec3f>> points, extent;  // by time code
};

/// Throws std::runtime_error where the text is not what it should be.
UsdFile readUsd(const std::filesystem::path& path);

}  // namespace ringlet::test
