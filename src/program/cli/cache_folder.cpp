// Implements cache_folder.h.
#include "program/cli/cache_folder.h"

#include <cstdlib>

namespace ringlet::program {
namespace {

// An empty variable counts as unset, and so does a relative path.
std::filesystem::path folderIn(const char* variable) {
  const char* value = std::getenv(variable);
  const std::filesystem::path path = value ? value : "";
  return path.is_absolute() ? path : std::filesystem::path();
}

}  // namespace

std::filesystem::path cacheFolder() {
  if (auto own = folderIn("RINGLET_CACHE_DIR"); !own.empty()) return own;
  if (const auto cache = folderIn("XDG_CACHE_HOME"); !cache.empty()) return cache / "ringlet";
  const auto home = folderIn("HOME");
  return home.empty() ? home : home / ".cache" / "ringlet";
}

}  // namespace ringlet::program
