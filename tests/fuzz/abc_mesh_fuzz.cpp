// Meshes that move in Alembic files.
#include "ringlet/motion/abc_mesh.h"

#include "tests/fuzz/fuzz_target.h"

namespace ringlet::fuzz {

const MemoryBound kMemory{.base = 16 << 20, .perByte = 1024};

void tryBytes(std::span<const std::byte> bytes) {
  const auto read = readAbcMesh(bytes, "fuzz.abc");
  if (!read) return;
  const auto& mesh = *read;
  demand(!mesh->triangles().empty() && mesh->firstSeconds() <= mesh->lastSeconds(),
         "a mesh has faces and times");
  for (const auto& triangle : mesh->triangles())
    for (const std::uint32_t corner : triangle) demand(corner < mesh->pointCount(), "corners are points");
  for (const double t : {mesh->firstSeconds(), (mesh->firstSeconds() + mesh->lastSeconds()) / 2, 1e9})
    demand(mesh->pointsAt(t).size() == mesh->pointCount(), "all points are there");
}

}  // namespace ringlet::fuzz
