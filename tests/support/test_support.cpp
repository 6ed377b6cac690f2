// Implements support/test_support.h.
#include "tests/support/test_support.h"

#include <unistd.h>

#include <cstdlib>

namespace ringlet::test {

std::optional<std::filesystem::path> dataFile(const std::string& relative) {
  namespace fs = std::filesystem;
  const char* folder = std::getenv("RINGLET_DATA");
  fs::path path =
      (folder ? fs::path(folder) : fs::path(RINGLET_SOURCE_DIR) / ".." / "shared" / "data") / relative;
  if (!fs::exists(path)) return std::nullopt;
  return path;
}

std::filesystem::path scratchFolder(const std::string& name) {
  auto folder = std::filesystem::temp_directory_path() / ("ringlet_test_" + std::to_string(getpid())) / name;
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder;
}

}  // namespace ringlet::test
