// .usdz files: what is read is a usable groom.
#include "ringlet/groom/usd/usd_file.h"

#include "tests/fuzz/fuzz_target.h"

namespace ringlet::fuzz {

const MemoryBound kMemory{.base = 16 << 20, .perByte = 1024};

void tryBytes(std::span<const std::byte> bytes) {
  const auto loaded = readUsd(bytes, "fuzz.usdz");
  if (loaded) demandUsable(loaded->groom);
}

}  // namespace ringlet::fuzz
