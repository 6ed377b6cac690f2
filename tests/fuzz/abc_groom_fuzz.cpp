// Curves in Alembic files, with and without what stands beside their points: what is read is a usable groom,
// and a groom's prims are of its strands.
#include "ringlet/groom/alembic/abc_groom.h"

#include <algorithm>

#include "tests/fuzz/fuzz_target.h"

namespace ringlet::fuzz {

const MemoryBound kMemory{.base = 16 << 20, .perByte = 1024};

void tryBytes(std::span<const std::byte> bytes) {
  for (const bool keepsPrims : {false, true}) {
    const auto loaded = readAbcGroom(bytes, "fuzz.abc", {.keepsPrims = keepsPrims});
    if (!loaded) continue;
    demandUsable(loaded->groom);
    std::size_t strand = 0;
    for (const GroomPrim& prim : loaded->prims) {
      demand(prim.firstStrand == strand, "prims follow each other");
      strand += prim.strandCount;
      for (const GroomValue& value : prim.values) {
        demand(value.numbers.empty() != value.texts.empty(), "a value has numbers or texts");
        const bool isUniform = value.interpolation == "uniform";
        demand(!isUniform || std::max(value.numbers.size(), value.texts.size()) >= prim.strandCount,
               "each strand has its value");
      }
    }
    demand(!keepsPrims || strand == loaded->groom.strandCount(), "prims have all strands");
  }
}

}  // namespace ringlet::fuzz
