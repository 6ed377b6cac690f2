// Meshes that move in Alembic files.
#include "ringlet/motion/abc_mesh.h"

#include "tests/fuzz/demand_mesh.h"

namespace ringlet::fuzz {

const MemoryBound kMemory{.base = 16 << 20, .perByte = 1024};

void tryBytes(std::span<const std::byte> bytes) {
  if (const auto read = readAbcMesh(bytes, "fuzz.abc")) demandMesh(**read);
}

}  // namespace ringlet::fuzz
