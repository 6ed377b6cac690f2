// Small PLY files of strands, three particles and two, as hairutil writes them.
#pragma once

#include <cstdint>
#include <string>

#include "tests/groom/strand_list_bytes.h"

namespace ringlet::test {

inline std::string plyHead(const std::string& format, std::size_t strands) {
  return "ply\nformat " + format +
         " 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\nproperty uchar "
         "red\nelement "
         "strand " +
         std::to_string(strands) +
         "\nproperty ushort nsegs\nelement edge 0\nproperty int vertex1\nproperty int vertex2\nend_header\n";
}

/// As text; `counts` is how many edges each strand has, a line each.
inline std::string plyText(const std::string& counts = "2\n1\n") {
  std::size_t strands = 0;
  for (const char c : counts) strands += c == '\n';
  return plyHead("ascii", strands) + "0 0 0 1\n0 -1 0 2\n0 -2 0.5 3\n1 0 0 4\n1 -1.5 0 5\n" + counts;
}

inline std::string plyBinary() {
  std::string out = plyHead("binary_little_endian", 2);
  for (const auto& [x, y, z] : {Vec3f{0, 0, 0}, {0, -1, 0}, {0, -2, 0.5f}, {1, 0, 0}, {1, -1.5f, 0}}) {
    for (const float value : {x, y, z}) appendBytes(out, value);
    out += '\7';
  }
  for (const std::uint16_t count : {std::uint16_t{2}, std::uint16_t{1}}) appendBytes(out, count);
  return out;
}

}  // namespace ringlet::test
