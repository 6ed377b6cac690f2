// Implements motion/scalp.h.
#include "ringlet/motion/scalp.h"

#include <fmt/format.h>

#include <cmath>

#include "ringlet/base/assert.h"
#include "ringlet/motion/affine.h"
#include "ringlet/motion/triangle_finder.h"

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

Corners cornersOf(const SkinnedMesh& mesh, std::span<const Vec3d> points, std::size_t triangle) {
  const auto [a, b, c] = mesh.triangles()[triangle];
  return {points[a], points[b], points[c]};
}

}  // namespace

Result<Scalp> Scalp::bind(std::shared_ptr<const SkinnedMesh> mesh, std::span<const Vec3d> roots, double t0,
                          double farthest) {
  RINGLET_ASSERT(mesh, "a scalp is a mesh");
  const std::vector<Vec3d> points = mesh->pointsAt(t0);
  const TriangleFinder tree(points, mesh->triangles());
  Scalp scalp;
  std::size_t lostCount = 0, worst = 0;
  double worstDistance = -1;
  for (std::size_t r = 0; r < roots.size(); ++r) {
    const auto place = tree.nearestTo(roots[r]);
    const double distance = place ? place->distance : INFINITY;
    if (!(distance <= farthest)) ++lostCount;
    if (distance > worstDistance) worstDistance = distance, worst = r;
    if (!place) continue;
    const Corners corners = cornersOf(*mesh, points, place->triangle);
    scalp.bindings_.push_back(
        {place->triangle, place->weights, corners.at(place->weights), corners.frame().conjugate()});
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
