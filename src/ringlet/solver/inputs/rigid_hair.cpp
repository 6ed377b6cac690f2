// Implements solver/inputs/rigid_hair.h.
#include "ringlet/solver/inputs/rigid_hair.h"

#include <algorithm>
#include <utility>

#include "ringlet/base/assert.h"
#include "ringlet/solver/inputs/frame_inputs.h"
#include "ringlet/solver/inputs/roots_input.h"
#include "ringlet/solver/simulation.h"

namespace ringlet {
namespace {

Vec3d placed(const HeadPose& head, const BodyPose& carrier, Vec3d shift, Vec3f point) {
  return carrier.position + rotate(carrier.rotation, static_cast<Vec3d>(point) + shift * head.shift);
}

}  // namespace

RigidHair::RigidHair(std::vector<RigidStrand> strands, std::size_t groomStrandCount)
    : strands_(std::move(strands)), groomStrandCount_(groomStrandCount), poses_(strands_.size()) {}

Result<RigidHair> RigidHair::create(const InputSource& from) {
  const InitialState& initial = from.initial;
  RigidHair self(from.rest.rigid, from.rest.groomStrandCount);
  if (!initial.rootShifts.empty())
    for (std::size_t k = 0; k < self.strands_.size(); ++k)
      self.poses_[k].shift = initial.rootShifts[self.strands_[k].strandInGroom];
  if (!initial.roots.empty()) {
    self.take(initial.rootsEarlier);
    self.take(initial.roots);
  }
  return self;
}

void RigidHair::take(std::span<const BodyPose> ofOneStep) {
  for (std::size_t k = 0; k < strands_.size(); ++k) {
    const BodyPose& next = ofOneStep[strands_[k].strandInGroom];
    poses_[k].oneStepEarlier = std::exchange(poses_[k].now, {next.position, normalized(next.rotation)});
  }
}

void RigidHair::writeFrame(std::size_t, const FrameContext& frame) {
  const std::span<const BodyPose> poses = frame.rootPoses;
  RINGLET_ASSERT(poses.size() % groomStrandCount_ == 0, "every strand has a pose in every step");
  if (poses.empty()) {
    for (Poses& p : poses_) p.oneStepEarlier = p.now;
    return;
  }
  if (poses.size() > groomStrandCount_) take(poses.last(2 * groomStrandCount_).first(groomStrandCount_));
  take(poses.last(groomStrandCount_));
}

void RigidHair::jump(const FrameContext& frame) {
  if (!frame.rootPoses.empty()) take(frame.rootPoses.last(groomStrandCount_));
  for (Poses& p : poses_) p.oneStepEarlier = p.now;
}

void RigidHair::rescale(double share) {
  for (Poses& p : poses_) p.oneStepEarlier = interpolate(p.now, p.oneStepEarlier, share);
}

std::vector<Vec3f> RigidHair::positions(const HeadPose& now) const {
  std::vector<Vec3f> points;
  for (std::size_t k = 0; k < strands_.size(); ++k) {
    const BodyPose carrier = carriedBy(now.rotation, poses_[k].now);
    for (Vec3f p : strands_[k].points)
      points.push_back(static_cast<Vec3f>(placed(now, carrier, poses_[k].shift, p)));
  }
  return points;
}

std::vector<Vec3f> RigidHair::velocities(const HeadPose& now, const HeadPose& oneStepEarlier,
                                         double stepSeconds) const {
  std::vector<Vec3f> values;
  for (std::size_t k = 0; k < strands_.size(); ++k) {
    const BodyPose here = carriedBy(now.rotation, poses_[k].now);
    const BodyPose before = carriedBy(oneStepEarlier.rotation, poses_[k].oneStepEarlier);
    const Vec3d shift = poses_[k].shift;
    for (Vec3f p : strands_[k].points) {
      const Vec3d way = placed(now, here, shift, p) - placed(oneStepEarlier, before, shift, p);
      values.push_back(static_cast<Vec3f>(way / stepSeconds));
    }
  }
  return values;
}

void RigidHair::scatter(std::span<const Vec3f> values, std::span<Vec3f> inGroomOrder) const {
  auto next = values.begin();
  for (const RigidStrand& strand : strands_) {
    const auto count = static_cast<std::ptrdiff_t>(strand.points.size());
    std::copy(next, next + count, inGroomOrder.begin() + strand.firstInGroom);
    next += count;
  }
}

}  // namespace ringlet
