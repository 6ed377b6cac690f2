// .data and .bin files: what is read is a usable groom. And mended it is one still, or has no strand.
#include "ringlet/groom/strand_list_file.h"

#include "ringlet/groom/mend_groom.h"
#include "tests/fuzz/fuzz_target.h"

namespace ringlet::fuzz {

const MemoryBound kMemory{.base = 1 << 20, .perByte = 128};

void tryBytes(std::span<const std::byte> bytes) {
  for (const auto read : {readStrandData, readStrandBin}) {
    const auto loaded = read(bytes, "fuzz.data");
    if (!loaded) continue;
    demandUsable(loaded->groom);
    const MendedGroom mended = mendGroom(loaded->groom, 3);
    if (mended.groom.strandCount() > 0) demandUsable(mended.groom);
  }
}

}  // namespace ringlet::fuzz
