// .ply files: what is read is a usable groom, of points alone too.
#include "ringlet/groom/ply_file.h"

#include "tests/fuzz/fuzz_target.h"

namespace ringlet::fuzz {

const MemoryBound kMemory{.base = 1 << 20, .perByte = 128};

void tryBytes(std::span<const std::byte> bytes) {
  for (const std::uint32_t pointsPerStrand : {0u, 3u}) {
    const auto loaded = readPly(bytes, "fuzz.ply", {.pointsPerStrand = pointsPerStrand});
    if (loaded) demandUsable(loaded->groom);
  }
}

}  // namespace ringlet::fuzz
