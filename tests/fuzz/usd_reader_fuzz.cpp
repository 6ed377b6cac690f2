// Animations as USD text.
#include "ringlet/output/usd_reader.h"

#include <numeric>

#include "tests/fuzz/memory_file.h"

namespace ringlet::fuzz {

const MemoryBound kMemory{.base = 1 << 20, .perByte = 64};

void tryBytes(std::span<const std::byte> bytes) {
  const MemoryFile file(bytes);
  auto reader = UsdReader::open(file.path());
  if (!reader) return;
  const auto& counts = reader->particleCounts();
  const std::uint64_t particles = std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
  std::vector<Vec3f> points;
  while (true) {
    const auto more = reader->readFrame(points);
    if (!more || !*more) break;
    demand(points.size() == particles, "a frame has every particle");
    demandFinite(std::span<const Vec3f>(points));
  }
}

}  // namespace ringlet::fuzz
