// Implements bodies/mesh_grid.h.
#include "ringlet/bodies/mesh_grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <thread>

#include "ringlet/base/in_parallel.h"
#include "ringlet/bodies/hole_film.h"
#include "ringlet/bodies/triangle_tree.h"

namespace ringlet {
namespace {

// What is known of every corner before it has a sign.
struct Samples {
  std::vector<float> magnitudes;  // distance to the nearest triangle [m]
  std::vector<float> windings;
};

Status checkSettings(const MeshGridSettings& settings) {
  if (settings.cells < 8 || settings.cells > 256) {
    return Error{
        fmt::format("a distance grid of {} cells along its longest side; expected 8 to 256", settings.cells)};
  }
  if (settings.padding < 1 || settings.padding > 16) {
    return Error{fmt::format("a distance grid with {} cells of room around the mesh; expected 1 to 16",
                             settings.padding)};
  }
  if (settings.threadCount < 0) {
    return Error{fmt::format("a distance grid made by {} threads; expected 0 (as many as there are) or more",
                             settings.threadCount)};
  }
  return {};
}

// A grid about the mesh, which is in its middle.
DistanceGrid emptyGrid(const Bounds& bounds, const MeshGridSettings& settings) {
  const Vec3d size = bounds.high - bounds.low, middle = (bounds.low + bounds.high) / 2;
  DistanceGrid grid;
  grid.cell = std::max({size.x, size.y, size.z}) / settings.cells;
  auto countAlong = [&](double side) {
    // Not one cell more for the last bit of a division.
    return static_cast<std::uint32_t>(std::ceil(side / grid.cell - 1e-9)) +
           2 * static_cast<std::uint32_t>(settings.padding);
  };
  grid.counts = {countAlong(size.x), countAlong(size.y), countAlong(size.z)};
  grid.origin = middle - Vec3d{double(grid.counts[0]), double(grid.counts[1]), double(grid.counts[2])} *
                             (grid.cell / 2);
  return grid;
}

// One row along X. No row needs another, so threads may take them in any order.
void sampleRow(const TriangleTree& tree, const DistanceGrid& grid, bool isWatertight, std::uint32_t y,
               std::uint32_t z, Samples& samples) {
  TriangleTree::Nearest nearest{0, 0};
  double winding = 0;
  for (std::uint32_t x = 0; x <= grid.counts[0]; ++x) {
    const Vec3d place = grid.origin + Vec3d{double(x), double(y), double(z)} * grid.cell;
    const double before = nearest.distance;
    nearest = tree.nearest(place, nearest.entry);
    // The winding number of a watertight mesh changes at the surface only, which is not between this corner
    // and the one before if either is further than a cell from it.
    const bool isSame = x > 0 && isWatertight && std::max(before, nearest.distance) > grid.cell * (1 + 1e-9);
    if (!isSame) winding = tree.windingNumber(place);
    const std::size_t i = grid.cornerIndex(x, y, z);
    samples.magnitudes[i] = static_cast<float>(nearest.distance);
    samples.windings[i] = static_cast<float>(winding);
  }
}

Samples sampleAll(const TriangleTree& tree, const DistanceGrid& grid, bool isWatertight, int threadCount) {
  const std::size_t cornerCount = grid.cornerIndex(grid.counts[0], grid.counts[1], grid.counts[2]) + 1;
  Samples samples{std::vector<float>(cornerCount), std::vector<float>(cornerCount)};
  std::atomic<std::uint32_t> nextLayer{0};
  auto takeLayers = [&] {
    for (std::uint32_t z = nextLayer++; z <= grid.counts[2]; z = nextLayer++) {
      for (std::uint32_t y = 0; y <= grid.counts[1]; ++y) sampleRow(tree, grid, isWatertight, y, z, samples);
    }
  };
  const unsigned wanted =
      threadCount > 0 ? static_cast<unsigned>(threadCount) : std::thread::hardware_concurrency();
  inParallel(std::min(wanted, grid.counts[2]), takeLayers);
  return samples;
}

}  // namespace

Result<MeshGrid> makeDistanceGrid(const TriangleMesh& mesh, const MeshGridSettings& settings) {
  if (Status status = checkSettings(settings); !status) return status.error();
  if (Status status = checkMesh(mesh); !status) return status.error();
  const Bounds bounds = boundsOf(mesh);
  const double reach = length(bounds.high - bounds.low);
  // Beyond these squares and cubes of lengths are not what they should be.
  if (!(reach > 1e-9 && reach < 1e9)) {
    return Error{fmt::format(
        "the mesh is {} m from corner to corner; expected a body of a size (is its unit right?)", reach)};
  }

  MeshGrid made;
  made.openEdges = openEdgeCount(mesh);
  made.grid = emptyGrid(bounds, settings);
  Samples samples = sampleAll(TriangleTree(mesh), made.grid, made.openEdges == 0, settings.threadCount);

  // Which way out the mesh says: by what most of its inside says. On the surface itself nothing is said.
  std::size_t inside = 0, turned = 0;
  for (std::size_t i = 0; i < samples.windings.size(); ++i) {
    if (double{samples.magnitudes[i]} < 1e-6 * made.grid.cell) continue;
    inside += samples.windings[i] > 0.5f;
    turned += samples.windings[i] < -0.5f;
  }
  const bool isInsideOut = turned > inside;
  if (inside == 0 && turned == 0) {
    return Error{fmt::format(
        "the mesh has no inside that a grid of cells of {:.3g} m can see ({} triangles, {} open edges); "
        "close it, make it thicker or take more than {} cells",
        made.grid.cell, mesh.triangles.size(), made.openEdges, settings.cells)};
  }
  if (isInsideOut) {
    for (float& winding : samples.windings) winding = -winding;
    made.warnings.push_back("the mesh is inside out, its triangles clockwise seen from outside; turned");
  }
  if (const auto lost = isInsideOut ? inside : turned; lost > 0) {
    made.warnings.push_back(
        fmt::format("a part of the mesh is inside out among others, some {:.2g} litres; it counts as outside",
                    static_cast<double>(lost) * std::pow(made.grid.cell, 3) * 1000));
  }
  if (made.openEdges > 0) {
    closeHoles(made.grid, samples.windings, samples.magnitudes);
    made.warnings.push_back(fmt::format(
        "the mesh is not watertight: {} edges do not have two triangles that agree on what is outside; its "
        "holes are closed by a film where its winding number is 1/2",
        made.openEdges));
  }

  made.grid.distances = std::move(samples.magnitudes);
  for (std::size_t i = 0; i < made.grid.distances.size(); ++i) {
    if (samples.windings[i] > 0.5f) made.grid.distances[i] = -made.grid.distances[i];
  }
  return made;
}

}  // namespace ringlet
