// Implements motion/head_scalp.h.
#include "ringlet/motion/head_scalp.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ringlet {
namespace {

// The time of the key before, where the head is cut at t.
double beforeCut(const Motion& head, double t) {
  if (!head.keyframes || !(t > 0 || !head.keyframes->times.empty())) return t;
  const Keyframes& keys = *head.keyframes;
  std::size_t after = 0;  // the first key later than t
  if (keys.times.empty()) {
    after = static_cast<std::size_t>(std::min(t / keys.secondsPerKey, double(keys.poses.size()))) + 1;
  } else {
    after = static_cast<std::size_t>(std::ranges::upper_bound(keys.times, t) - keys.times.begin());
  }
  if (after == 0 || after >= keys.poses.size() || !keys.isCut(after - 1)) return t;
  return keys.timeOf(after - 1);
}

}  // namespace

BodyPose rootPoseOn(const HeadPose& head, const HeadPose& scalp, const HeadPose& headAtBinding) {
  const Quatd toHead = head.rotation.conjugate();
  return {rotate(toHead, scalp.position + rotate(scalp.rotation, headAtBinding.position) - head.position),
          normalized(toHead * scalp.rotation * headAtBinding.rotation)};
}

Result<HeadScalp> HeadScalp::bind(std::shared_ptr<const MeshMotion> mesh, std::span<const Vec3d> roots,
                                  const Motion& head, const HeadScalpChoice& choice) {
  const double first = mesh->firstSeconds();
  const HeadPose pose = head.poseAt(choice.start);
  std::vector<Vec3d> inWorld;
  for (Vec3d root : roots) inWorld.push_back(pose.position - choice.offset + rotate(pose.rotation, root));
  auto scalp = Scalp::bind(std::move(mesh), inWorld, first, choice.farthest);
  if (!scalp) return scalp.error();
  return HeadScalp(std::move(*scalp), head, choice, first);
}

HeadPose HeadScalp::headAt(double t) const {
  HeadPose pose = head_.poseAt(t);
  pose.position -= choice_.offset;
  return pose;
}

TriangleMesh HeadScalp::meshAtBinding() const {
  const HeadPose head = headAt(choice_.start);
  const Quatd toHead = head.rotation.conjugate();
  TriangleMesh mesh{scalp_.mesh()->pointsAt(firstSeconds_), scalp_.mesh()->triangles()};
  for (Vec3d& point : mesh.points) point = rotate(toHead, point - head.position);
  return mesh;
}

std::vector<BodyPose> HeadScalp::rootPosesAt(double t) const {
  t = beforeCut(head_, t);
  if (t < choice_.start) return std::vector<BodyPose>(scalp_.rootCount());
  const HeadPose head = headAt(t), bound = headAt(choice_.start);
  std::vector<BodyPose> poses;
  poses.reserve(scalp_.rootCount());
  for (const HeadPose& scalp : scalp_.posesAt(firstSeconds_ + t - choice_.start))
    poses.push_back(rootPoseOn(head, scalp, bound));
  return poses;
}

std::vector<Vec3d> HeadScalp::placesAt(double t, const HeadPose& head, std::span<const Vec3d> roots) const {
  const std::vector<BodyPose> poses = rootPosesAt(t);
  std::vector<Vec3d> places;
  places.reserve(roots.size());
  for (std::size_t r = 0; r < roots.size(); ++r)
    places.push_back(head.position +
                     rotate(head.rotation, poses[r].position + rotate(poses[r].rotation, roots[r])));
  return places;
}

}  // namespace ringlet
