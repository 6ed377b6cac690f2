// Meshes that move in USD files, text and crates.
#include "ringlet/motion/usd_mesh.h"

#include "tests/fuzz/demand_mesh.h"

namespace ringlet::fuzz {

const MemoryBound kMemory{.base = 16 << 20, .perByte = 1024};

void tryBytes(std::span<const std::byte> bytes) {
  if (const auto read = readUsdMesh(bytes, "fuzz.usd", {.upIsZ = true})) demandMesh(**read);
}

}  // namespace ringlet::fuzz
