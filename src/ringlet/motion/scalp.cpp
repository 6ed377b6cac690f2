// Implements motion/scalp.h.
#include "ringlet/motion/scalp.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "ringlet/base/assert.h"
#include "ringlet/bodies/distance_to_triangle.h"
#include "ringlet/bodies/triangle_tree.h"
#include "ringlet/motion/affine.h"

namespace ringlet {
namespace {

struct Corners {
  Vec3d a, b, c;

  Vec3d at(const std::array<double, 3>& weights) const {
    return a * weights[0] + b * weights[1] + c * weights[2];
  }
  Quatd frame() const {
    const Vec3d x = normalizedOr(b - a, Vec3d{1, 0, 0});
    const Vec3d z = normalizedOr(cross(x, c - a), anyNormal(x));
    return rotationOf(x, cross(z, x), z);
  }
};

Corners cornersOf(const MeshMotion& mesh, std::span<const Vec3d> points, std::size_t triangle) {
  const auto [a, b, c] = mesh.triangles()[triangle];
  return {points[a], points[b], points[c]};
}

// The triangles roots can be bound to: those with an area have a frame. `indices`: which of the mesh they
// are.
TriangleMesh groundOf(const MeshMotion& mesh, const std::vector<Vec3d>& points,
                      std::vector<std::size_t>& indices) {
  TriangleMesh ground{points, {}};
  for (std::size_t k = 0; k < mesh.triangles().size(); ++k) {
    const Corners corners = cornersOf(mesh, points, k);
    const double area = length(cross(corners.b - corners.a, corners.c - corners.a));
    if (!(area > 0) || !std::isfinite(area) || !isFinite(corners.a)) continue;
    ground.triangles.push_back(mesh.triangles()[k]);
    indices.push_back(k);
  }
  return ground;
}

}  // namespace

Result<Scalp> Scalp::bind(std::shared_ptr<const MeshMotion> mesh, std::span<const Vec3d> roots, double t0,
                          double farthest) {
  RINGLET_ASSERT(mesh, "a scalp is a mesh");
  const std::vector<Vec3d> points = mesh->pointsAt(t0);
  std::vector<std::size_t> indices;
  const TriangleMesh ground = groundOf(*mesh, points, indices);
  std::optional<TriangleTree> tree;
  if (!indices.empty()) tree.emplace(ground);
  Scalp scalp;
  std::size_t lostCount = 0, worst = 0;
  double worstDistance = -1;
  for (std::size_t r = 0; r < roots.size(); ++r) {
    const bool hasPlace = tree && isFinite(roots[r]);
    const auto nearest = hasPlace ? tree->nearest(roots[r]) : TriangleTree::Nearest{INFINITY, 0, 0};
    if (!(nearest.distance <= farthest)) ++lostCount;
    if (nearest.distance > worstDistance) worstDistance = nearest.distance, worst = r;
    if (!hasPlace) continue;
    const std::size_t triangle = indices[nearest.triangle];
    const Corners corners = cornersOf(*mesh, points, triangle);
    const auto weights = closestShares(roots[r], corners.a, corners.b, corners.c);
    scalp.bindings_.push_back({triangle, weights, corners.at(weights), corners.frame().conjugate()});
  }
  if (lostCount > 0) {
    return Error{fmt::format(
        "{} of {} roots are further than {:.4g} m from the scalp; strand {} is {:.4g} m away. Are units, up "
        "axis and the pose at {:.4g} s those the groom was made for?",
        lostCount, roots.size(), farthest, worst, worstDistance, t0)};
  }
  scalp.farthestRoot_ = roots.empty() ? 0 : worstDistance;
  scalp.mesh_ = std::move(mesh);
  return scalp;
}

std::vector<HeadPose> Scalp::posesAt(double t) const {
  const std::vector<Vec3d> points = mesh_->pointsAt(t);
  std::vector<HeadPose> poses;
  poses.reserve(bindings_.size());
  for (const Binding& binding : bindings_) {
    const Corners corners = cornersOf(*mesh_, points, binding.triangle);
    const Quatd rotation = normalized(corners.frame() * binding.inverseFrame);
    poses.push_back({corners.at(binding.weights) - rotate(rotation, binding.anchor), rotation});
  }
  return poses;
}

}  // namespace ringlet
