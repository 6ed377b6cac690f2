// .data and .bin files: what is read is a usable groom. And mended it is one still, or has no strand, and
// there is nothing more to mend; strands turned round by the head are as many.
#include "ringlet/groom/strand_list_file.h"

#include "ringlet/groom/mend_groom.h"
#include "ringlet/groom/root_ends.h"
#include "tests/fuzz/fuzz_target.h"

namespace ringlet::fuzz {

const MemoryBound kMemory{.base = 1 << 20, .perByte = 128};

void tryBytes(std::span<const std::byte> bytes) {
  for (const auto read : {readStrandData, readStrandBin}) {
    const auto loaded = read(bytes, "fuzz.data");
    if (!loaded) continue;
    demandUsable(loaded->groom);
    demand(findRootEnds(loaded->groom).isReversed.size() == loaded->groom.strandCount(), "a word a strand");
    const Groom once = mendGroom(loaded->groom).groom;
    demand(mendGroom(once).groom.points == once.points, "mended at once");
    const MendedGroom mended = mendGroom(loaded->groom, 3);
    if (mended.groom.strandCount() > 0) demandUsable(mended.groom);
  }
}

}  // namespace ringlet::fuzz
