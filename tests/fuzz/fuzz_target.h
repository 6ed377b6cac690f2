// What a fuzzer gives and gets. Each STEM_fuzz.cpp defines kMemory and tryBytes; fuzz_main.cpp calls them.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <span>
#include <string_view>

#include "ringlet/base/vec3.h"
#include "ringlet/groom/groom.h"

namespace ringlet::fuzz {

/// The most memory that reading a file may hold at once: docs/fuzzing.md promises it.
struct MemoryBound {
  std::size_t base = 0;     // [bytes]
  std::size_t perByte = 0;  // of the file [bytes]
};
extern const MemoryBound kMemory;

/// Reads the bytes as a file and holds the result to what its reader promises.
void tryBytes(std::span<const std::byte> bytes);

/// No file is below it, so that nothing a file names is read.
inline const std::filesystem::path kNoFolder = "/proc/self/no-folder";

inline std::string_view textOf(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// Ends the program where a promise is broken; the fuzzer then keeps the file.
inline void demand(bool isKept, const char* promise) {
  if (isKept) return;
  std::fprintf(stderr, "ringlet: a reader broke its promise: %s\n", promise);
  std::abort();
}

inline bool isFinite(const Vec3f& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}
inline bool isFinite(const Vec3d& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

template <class Point>
void demandFinite(std::span<const Point> points) {
  for (const Point& point : points) demand(isFinite(point), "all points are finite");
}

/// What every reader of grooms promises.
inline void demandUsable(const Groom& groom) {
  demand(groom.strandCount() > 0, "a groom has a strand");
  demand(groom.firstPoint.front() == 0 && groom.firstPoint.back() == groom.points.size(),
         "strands cover all points");
  for (std::size_t s = 0; s < groom.strandCount(); ++s)
    demand(groom.firstPoint[s] + 2 <= groom.firstPoint[s + 1], "a strand has two points");
  demandFinite(std::span<const Vec3f>(groom.points));
}

}  // namespace ringlet::fuzz
