// Implements scenes/load/bending_body.h.
#include "ringlet/scenes/load/bending_body.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "ringlet/base/bounds.h"
#include "ringlet/bodies/make_bending_mesh.h"
#include "ringlet/groom/root_ends.h"
#include "ringlet/measure/head_fit.h"
#include "ringlet/motion/bust_motion.h"
#include "ringlet/scenes/load/moving_mesh.h"

namespace ringlet {
namespace {

constexpr std::size_t kPointsToFit = 2000;
constexpr int kMostLooks = 1000;

double longestStrand(const Groom& groom) {
  double longest = 0;
  for (std::size_t s = 0; s < groom.strandCount(); ++s) {
    double length = 0;
    const auto strand = groom.strand(s);
    for (std::size_t i = 1; i < strand.size(); ++i)
      length += ringlet::length(Vec3d(strand[i]) - Vec3d(strand[i - 1]));
    longest = std::max(longest, length * groom.metresPerUnit);
  }
  return longest;
}

// Where hair can come to as the run begins, seen from the body's carrier.
Bounds reachOfHair(const Groom& groom, const HeadPose& head, const BodyPose& carrier) {
  Bounds bounds = Bounds::none();
  for (const Vec3d root : rootPlaces(groom)) {
    const Vec3d place = head.position + rotate(head.rotation, root);
    bounds.add(seenFrom(carrier, place));
  }
  const Vec3d room = Vec3d{1, 1, 1} * longestStrand(groom);
  return {bounds.low - room, bounds.high + room};
}

Bounds common(const Bounds& a, const Bounds& b) {
  return {{std::max(a.low.x, b.low.x), std::max(a.low.y, b.low.y), std::max(a.low.z, b.low.z)},
          {std::min(a.high.x, b.high.x), std::min(a.high.y, b.high.y), std::min(a.high.z, b.high.z)}};
}

// Some points of a mesh near the hair, of which a rigid motion is told.
class PointsNear {
 public:
  PointsNear(const std::vector<Vec3d>& points, const Bounds& near) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (near.contains(points[i])) indices_.push_back(i);
    }
    const std::size_t stride = 1 + indices_.size() / kPointsToFit;
    for (std::size_t k = 0; k * stride < indices_.size(); ++k) indices_[k] = indices_[k * stride];
    indices_.resize((indices_.size() + stride - 1) / stride);
    first_ = of(points);
  }
  /// How they have moved since, as most of them did.
  HeadPose motionTo(const std::vector<Vec3d>& points) const { return fitSharedMotion(first_, of(points)); }

 private:
  std::vector<Vec3d> of(const std::vector<Vec3d>& points) const {
    std::vector<Vec3d> some;
    for (const std::size_t i : indices_) some.push_back(points[i]);
    return some;
  }

  std::vector<std::size_t> indices_;
  std::vector<Vec3d> first_;
};

// Times of the run at which the mesh is looked at: a look a frame, or some 1000 looks [s]. They cover all of
// its motion, whatever part of it is run: a shorter run has the same carrier and grid, and so the same bits.
std::vector<double> looksAt(const MovingBody& moving, double framesPerSecond) {
  const double end = moving.start + moving.mesh->lastSeconds() - moving.mesh->firstSeconds();
  const int last = static_cast<int>(std::clamp(std::ceil(end * framesPerSecond), 1.0, 1e6));
  const int stride = 1 + last / kMostLooks;
  std::vector<double> times;
  for (int frame = 0; frame < last + stride; frame += stride)
    times.push_back(std::min(frame, last) / framesPerSecond);
  return times;
}

// The rigid motion that most of the mesh near the hair shares, a key a look: what does not bend then stays
// where it is in the grid.
Motion sharedMotion(const MovingBody& moving, double preRollSeconds, const LoadedScene& loaded, bool isAll) {
  const std::vector<Vec3d> first = moving.pointsAt(0, loaded.motion);
  Bounds all = Bounds::none();
  for (const Vec3d p : first) all.add(p);
  const PointsNear near(first, isAll ? all : reachOfHair(loaded.groom, loaded.motion.poseAt(0), {}));
  Keyframes keys;
  keys.interpolation = Keyframes::Interpolation::linear;
  keys.restsAtEnds = true;
  const double framesPerSecond = loaded.settings.framesPerSecond;
  const int before = static_cast<int>(std::ceil(preRollSeconds * framesPerSecond));
  for (int frame = -before; frame < 0; ++frame) keys.times.push_back(frame / framesPerSecond);
  for (const double t : looksAt(moving, framesPerSecond)) keys.times.push_back(t);
  for (const double t : keys.times) keys.poses.push_back(near.motionTo(moving.pointsAt(t, loaded.motion)));
  Motion motion;
  motion.kind = MotionKind::keyframes;
  motion.keyframes = std::make_shared<const Keyframes>(std::move(keys));
  return motion;
}

// Where the mesh comes to, seen from its carrier.
Bounds placesOf(const MovingBody& moving, const Body& body, const LoadedScene& loaded) {
  Bounds all = Bounds::none();
  for (const double t : looksAt(moving, loaded.settings.framesPerSecond))
    for (const Vec3d p : moving.pointsSeenAt(t, body, loaded.motion)) all.add(p);
  return all;
}

}  // namespace

Status loadBendingBody(const SceneFile& file, std::size_t index, LoadedScene& loaded) {
  const SceneBody& scene = file.bodies[index];
  Body& body = loaded.bodies[index];
  const auto read = scene.generate.empty() ? readMovingMesh(sourceOf(scene), file, loaded)
                                           : Result(MovingMesh{generatedMotion(scene.generate), {}});
  if (!read)
    return Error{fmt::format("the body {}: {}", body.name, read.error().message), read.error().fault};
  MovingBody moving{index, read->mesh, scene.start, read->offset, body};
  const bool isCloth = scene.sides == "both", isAll = isCloth || scene.region == "all";
  if (scene.joint.empty() && !scene.moves)
    body.motion = sharedMotion(moving, file.motion.preRollSeconds, loaded, isAll);

  const auto carrierAt = [&](double t) { return body.poseAt(t, loaded.motion.poseAt(t)); };
  TriangleMesh first{moving.pointsSeenAt(0, body, loaded.motion), read->mesh->triangles()};
  const Bounds all = placesOf(moving, body, loaded);
  const Bounds box =
      isAll ? all : common(all, reachOfHair(loaded.groom, loaded.motion.poseAt(0), carrierAt(0)));
  if (!box.hasRoom())
    return Error{
        fmt::format("the body {}: the longest strand does not reach its mesh; is its unit or place right? "
                    "region = \"all\" gives all of it a grid",
                    body.name)};
  std::vector<std::string> warnings;
  if (Status made = makeBendingMesh(std::move(first), {box, all, scene.cells, isCloth}, body, warnings);
      !made)
    return Error{fmt::format("the body {}: {}", body.name, made.error().message)};
  for (const std::string& warning : warnings)
    loaded.warnings.push_back(fmt::format("the body {}: {}", body.name, warning));
  loaded.moving.push_back(std::move(moving));
  return {};
}

}  // namespace ringlet
