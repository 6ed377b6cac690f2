// Files of factors by strand, of a scene's maps: strands rise, and factors are in their range.
#include "ringlet/scenes/load/scene_maps.h"
#include "tests/fuzz/fuzz_target.h"

namespace ringlet::fuzz {

const MemoryBound kMemory{.base = 1 << 20, .perByte = 64};

void tryBytes(std::span<const std::byte> bytes) {
  const auto runs = parseStrandFactors(textOf(bytes));
  if (!runs) return;
  for (std::size_t i = 0; i < runs->size(); ++i) {
    const StrandRun& run = (*runs)[i];
    demand(run.first == run.last && (i == 0 || run.first > (*runs)[i - 1].last), "strands rise");
    demand(run.factor >= static_cast<float>(kLeastStrandFactor) &&
               run.factor <= static_cast<float>(kMostStrandFactor),
           "factors are in their range");
  }
}

}  // namespace ringlet::fuzz
