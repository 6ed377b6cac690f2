// Implements support/test_support.h.
#include "tests/support/test_support.h"

#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <utility>

#include "ringlet/base/assert.h"

namespace ringlet::test {

std::optional<std::filesystem::path> dataFile(const std::string& relative) {
  namespace fs = std::filesystem;
  const char* folder = std::getenv("RINGLET_DATA");
  fs::path path =
      (folder ? fs::path(folder) : fs::path(RINGLET_SOURCE_DIR) / ".." / "shared" / "data") / relative;
  if (!fs::exists(path)) return std::nullopt;
  return path;
}

std::string readText(const std::filesystem::path& path) {
  std::ostringstream bytes;
  bytes << std::ifstream(path, std::ios::binary).rdbuf();
  return std::move(bytes).str();
}

double farthestApart(std::span<const Vec3f> a, std::span<const Vec3f> b) {
  RINGLET_ASSERT(a.size() == b.size(), "as many of both");
  double farthest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double apart = length(static_cast<Vec3d>(a[i]) - static_cast<Vec3d>(b[i]));
    if (!(apart <= farthest)) farthest = apart;
    if (std::isnan(farthest)) return farthest;
  }
  return farthest;
}

std::filesystem::path scratchFolder(const std::string& name) {
  auto folder = std::filesystem::temp_directory_path() / ("ringlet_test_" + std::to_string(getpid())) / name;
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder;
}

}  // namespace ringlet::test
