// Implements bodies/mesh_scalp.h.
#include "ringlet/bodies/mesh_scalp.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "ringlet/bodies/distance_to_triangle.h"
#include "ringlet/bodies/grid_sample.h"
#include "ringlet/bodies/mesh_grid.h"
#include "ringlet/bodies/triangle_tree.h"

namespace ringlet {
namespace {

// Beyond its grid heights are too small, so that hair would be raised too far: a third of a head reaches
// further than hair is lifted.
constexpr MeshGridSettings kGrid{.cells = 48, .padding = 16};

class MeshScalp final : public ScalpSurface {
 public:
  MeshScalp(const TriangleMesh& mesh, DistanceGrid grid) : mesh_(mesh), tree_(mesh), grid_(std::move(grid)) {
    for (const auto& triangle : mesh.triangles)
      for (const std::uint32_t point : triangle) reach_ = std::max(reach_, length(mesh.points[point]));
  }

  std::optional<ScalpRoot> rootAlong(Vec3d direction) const override {
    // No step is longer than the surface is away, nor shorter than what the grid is good to.
    const double least = 0.02 * grid_.cell;
    double far = reach_ + grid_.cell;
    while (far > 0) {
      const double height = heightOf(direction * far).height;
      if (height < least) break;
      far -= height;
    }
    if (far <= 0) return std::nullopt;
    // The grid closes holes; no hair grows there.
    const Vec3d position = nearest(direction * far);
    if (length(position - direction * far) > grid_.cell) return std::nullopt;
    return ScalpRoot{normalizedOr(position, direction), position, heightOf(position).outward};
  }

  ScalpHeight heightOf(Vec3d place) const override {
    const GridSample sample = sampleGrid(grid_, place);
    return {sample.distance, sample.direction};
  }

  Vec3d raisedTo(Vec3d place, double height) const override {
    const ScalpHeight now = heightOf(place);
    return place + now.outward * (height - now.height);
  }

 private:
  Vec3d nearest(Vec3d place) const {
    const auto& [a, b, c] = mesh_.triangles[tree_.nearest(place).triangle];
    const Vec3d corners[] = {mesh_.points[a], mesh_.points[b], mesh_.points[c]};
    const std::array<double, 3> shares = closestShares(place, corners[0], corners[1], corners[2]);
    return corners[0] * shares[0] + corners[1] * shares[1] + corners[2] * shares[2];
  }

  TriangleMesh mesh_;
  TriangleTree tree_;
  DistanceGrid grid_;
  double reach_ = 0;  // no point is further from the origin [m]
};

}  // namespace

Result<std::shared_ptr<const ScalpSurface>> makeMeshScalp(const TriangleMesh& mesh) {
  auto grid = makeDistanceGrid(mesh, kGrid);
  if (!grid) return grid.error();
  return std::shared_ptr<const ScalpSurface>(std::make_shared<MeshScalp>(mesh, std::move(grid->grid)));
}

}  // namespace ringlet
