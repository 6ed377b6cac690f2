// Implements motion/usd_skinned_mesh.h.
#include "ringlet/motion/usd_skinned_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <tuple>
#include <utility>

namespace ringlet {
namespace {

constexpr const char* kAnimationSource = "skel:animationSource";

std::vector<const std::vector<double>*> deformerTimes(const UsdDeformers& deformers) {
  std::vector<const std::vector<double>*> times;
  if (const auto* weights = deformers.shapes.seconds()) times.push_back(weights);
  if (deformers.skin)
    for (const UsdTrack& track : deformers.skin->joints().tracks()) times.push_back(&track.seconds());
  return times;
}

// By USD the Skeleton prim or one above it names the animation; older files have it at the mesh.
Result<std::optional<std::uint32_t>> animationOf(const UsdPrims& prims, std::uint32_t mesh,
                                                 std::optional<std::uint32_t> skeleton) {
  auto source = skeleton ? prims.nearest(*skeleton, kAnimationSource) : std::nullopt;
  if (!source) source = prims.nearest(mesh, kAnimationSource);
  if (!source) return std::optional<std::uint32_t>();
  const auto animation = prims.onlyTargetOf(*source, "SkelAnimation");
  if (!animation) return animation.error();
  return std::optional(*animation);
}

}  // namespace

bool UsdDeformers::move() const {
  return std::ranges::any_of(deformerTimes(*this), [](const auto* times) { return times->size() > 1; });
}

Result<UsdDeformers> readUsdDeformers(const UsdPrims& prims, std::uint32_t mesh, std::size_t pointCount,
                                      std::vector<std::string>& warnings) {
  UsdDeformers deformers;
  deformers.placedBy = mesh;
  std::optional<std::uint32_t> skeleton;
  if (const auto binding = prims.nearest(mesh, "skel:skeleton")) {
    const auto bound = prims.onlyTargetOf(*binding, "Skeleton");
    if (!bound) return bound.error();
    skeleton = *bound;
  }
  const auto animation = animationOf(prims, mesh, skeleton);
  if (!animation) return animation.error();
  auto shapes = UsdBlendShapes::of(prims, mesh, pointCount, *animation, warnings);
  if (!shapes) return shapes.error();
  deformers.shapes = std::move(*shapes);
  auto skin = UsdSkin::of(prims, mesh, pointCount, skeleton, *animation, warnings);
  if (!skin) return skin.error();
  deformers.skin = std::move(*skin);
  if (deformers.skin) deformers.placedBy = *skeleton;
  return deformers;
}

UsdSkinnedMesh::UsdSkinnedMesh(SampledMesh shape, UsdDeformers deformers, PlacementSamples placed)
    : shape_(std::move(shape)), deformers_(std::move(deformers)), placed_(std::move(placed)) {
  double first = std::numeric_limits<double>::infinity(), last = -first;
  const auto count = [&](double begin, double end) {
    if (begin == end) return;  // one sample holds at all times
    first = std::min(first, begin);
    last = std::max(last, end);
  };
  count(shape_.firstSeconds(), shape_.lastSeconds());
  count(placed_.seconds.front(), placed_.seconds.back());
  for (const std::vector<double>* times : deformerTimes(deformers_)) count(times->front(), times->back());
  if (first <= last) std::tie(firstSeconds_, lastSeconds_) = std::pair(first, last);
}

Result<UsdSkinnedMesh> UsdSkinnedMesh::of(SampledMesh shape, UsdDeformers deformers,
                                          PlacementSamples placed) {
  if (Status checked = checkPlacements(placed); !checked) return checked.error();
  UsdSkinnedMesh mesh(std::move(shape), std::move(deformers), std::move(placed));
  for (const double t : {mesh.firstSeconds(), mesh.lastSeconds()})
    if (!std::ranges::all_of(mesh.pointsAt(t), isFinite<double>))
      return Error{fmt::format("it has points beyond all numbers at {} s", t)};
  return mesh;
}

std::vector<Vec3d> UsdSkinnedMesh::pointsAt(double t) const {
  std::vector<Vec3d> points = shape_.pointsAt(t);
  deformers_.shapes.addTo(points, t);
  const Affine placement = placementAt(placed_, t);
  if (deformers_.skin) {
    deformers_.skin->move(points, t, placement);
  } else {
    for (Vec3d& point : points) point = placement(point);
  }
  return points;
}

}  // namespace ringlet
