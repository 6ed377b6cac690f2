// Implements base/is_below.h.
#include "ringlet/base/is_below.h"

#include <algorithm>
#include <system_error>

namespace ringlet {

bool isBelow(const std::filesystem::path& path, const std::filesystem::path& folder) {
  std::error_code code;
  const auto base = std::filesystem::canonical(folder.empty() ? "." : folder, code);
  if (code) return false;
  const auto whole = std::filesystem::weakly_canonical(path, code);
  return !code && std::ranges::mismatch(base, whole).in1 == base.end();
}

}  // namespace ringlet
