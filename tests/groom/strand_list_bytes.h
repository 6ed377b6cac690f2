// The bytes of .data and .bin files.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "ringlet/base/vec3.h"

namespace ringlet::test {

template <class Value>
void appendBytes(std::string& out, const Value& value) {
  out.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// Strands of so many points, of `floats` numbers each, of which the first three are (s, i, 0.5).
inline std::string strandList(const std::vector<std::int32_t>& counts, int floats) {
  std::string out;
  appendBytes(out, static_cast<std::int32_t>(counts.size()));
  for (std::size_t s = 0; s < counts.size(); ++s) {
    appendBytes(out, counts[s]);
    for (std::int32_t i = 0; i < counts[s]; ++i) {
      for (int k = 0; k < floats; ++k)
        appendBytes(out, k == 0   ? static_cast<float>(s)
                         : k == 1 ? static_cast<float>(i)
                         : k == 2 ? 0.5f
                                  : -7.f);
    }
  }
  return out;
}

}  // namespace ringlet::test
