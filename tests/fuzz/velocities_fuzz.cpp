// Grids of velocities as NumPy writes them: as many as there are nodes, and finite.
#include <cmath>

#include "ringlet/scenes/frames/velocity_file.h"
#include "tests/fuzz/fuzz_target.h"

namespace ringlet::fuzz {

const MemoryBound kMemory{.base = 1 << 20, .perByte = 64};

void tryBytes(std::span<const std::byte> bytes) {
  const auto grid = parseVelocities(bytes, 0.1);
  if (!grid) return;
  demand(grid->velocities.size() == std::size_t(grid->nodes[0]) * grid->nodes[1] * grid->nodes[2],
         "every node has a velocity");
  for (const Vec3f& v : grid->velocities)
    demand(std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z), "velocities are finite");
}

}  // namespace ringlet::fuzz
