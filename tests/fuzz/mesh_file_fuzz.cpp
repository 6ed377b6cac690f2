// Meshes in OBJ files, and the distance grids made of them.
#include "ringlet/bodies/mesh_file.h"

#include "ringlet/bodies/mesh_grid.h"
#include "tests/fuzz/fuzz_target.h"

namespace ringlet::fuzz {

// The grid of 8 cells, and the mesh with its tree.
const MemoryBound kMemory{.base = 16 << 20, .perByte = 1024};

void tryBytes(std::span<const std::byte> bytes) {
  const auto mesh = readObjMesh(bytes, "fuzz.obj", 0.01);
  if (!mesh) return;
  demand(static_cast<bool>(checkMesh(*mesh)), "a mesh that is read passes checkMesh");
  const auto made = makeDistanceGrid(*mesh, {.cells = 8, .padding = 1, .threadCount = 1});
  if (!made) return;
  const DistanceGrid& grid = made->grid;
  demand(grid.cell > 0 && std::isfinite(grid.cell) && isFinite(grid.origin), "a grid has a place and a size");
  const std::size_t corners = (grid.counts[0] + std::size_t{1}) * (grid.counts[1] + std::size_t{1}) *
                              (grid.counts[2] + std::size_t{1});
  demand(grid.cellCount() > 0 && grid.distances.size() == corners, "a grid has a number for every corner");
  for (const float distance : grid.distances) demand(std::isfinite(distance), "all distances are finite");
}

}  // namespace ringlet::fuzz
