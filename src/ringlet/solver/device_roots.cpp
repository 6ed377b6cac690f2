// Implements solver/device_roots.h.
#include "ringlet/solver/device_roots.h"

#include <utility>

#include "ringlet/base/assert.h"

namespace ringlet {
namespace {

layout::vec4 packed(Vec3d v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z), 0};
}
layout::vec4 packed(Quatd q) {
  return {static_cast<float>(q.x), static_cast<float>(q.y), static_cast<float>(q.z), static_cast<float>(q.w)};
}

}  // namespace

BodyPose carriedBy(Quatd headRotation, const BodyPose& root) {
  return {rotate(headRotation, root.position), headRotation * root.rotation};
}

Result<DeviceRoots> DeviceRoots::create(gpu::Device& device, const RestState& rest, const Settings& settings,
                                        bool areMoving, std::size_t slots) {
  const std::uint64_t strands = areMoving ? rest.strands.size() : 0;
  const std::uint64_t poses = (static_cast<std::uint64_t>(settings.stepsPerFrame) + 1) * strands;
  auto buffer = FrameInput::create(device, poses * sizeof(layout::RootPose), slots, "root poses");
  if (!buffer) return buffer.error();
  DeviceRoots roots(std::move(*buffer), settings.stepSeconds());
  if (areMoving) roots.strandInGroom_.assign(rest.strandInGroom.begin(), rest.strandInGroom.end());
  roots.now_.resize(strands);
  roots.oneStepEarlier_.resize(strands);
  return roots;
}

std::vector<BodyPose> DeviceRoots::inOrder(std::span<const BodyPose> poses) const {
  RINGLET_ASSERT(areMoving(), "strands have poses of their own only with KernelChoice::movingRoots");
  RINGLET_ASSERT(poses.size() == strandInGroom_.size(), "every strand has a pose in every step");
  std::vector<BodyPose> ordered;
  ordered.reserve(poses.size());
  for (const std::uint32_t strand : strandInGroom_)
    ordered.push_back({poses[strand].position, normalized(poses[strand].rotation)});
  return ordered;
}

void DeviceRoots::place(std::span<const BodyPose> now, std::span<const BodyPose> oneStepEarlier) {
  now_ = inOrder(now);
  oneStepEarlier_ = inOrder(oneStepEarlier);
}

void DeviceRoots::writeFrame(std::size_t slot, std::span<const HeadPose> heads,
                             std::span<const BodyPose> poses) {
  const std::size_t count = now_.size();
  RINGLET_ASSERT(poses.empty() || poses.size() == (heads.size() - 2) * count,
                 "every strand has a pose in every step");
  if (count == 0) return;
  const auto out = poses_.of<layout::RootPose>(slot);
  std::vector<BodyPose> before(count);  // what carried the strand one pose earlier
  for (std::size_t s = 0; s < count; ++s) before[s] = carriedBy(heads[0].rotation, oneStepEarlier_[s]);
  for (std::size_t pose = 0; pose + 1 < heads.size(); ++pose) {
    if (pose > 0) {
      std::vector<BodyPose> next = poses.empty() ? now_ : inOrder(poses.subspan((pose - 1) * count, count));
      oneStepEarlier_ = std::exchange(now_, std::move(next));
    }
    const Quatd head = normalized(heads[pose + 1].rotation);
    for (std::size_t s = 0; s < count; ++s) {
      const BodyPose now = carriedBy(head, now_[s]);
      const Quatd turn = now.rotation * before[s].rotation.conjugate();
      const Vec3d velocity = (now.position - before[s].position) / stepSeconds_;
      out[pose * count + s] = {packed(now.position), packed(now.rotation), packed(turn), packed(velocity)};
      before[s] = now;
    }
  }
}

void DeviceRoots::endFrame(std::span<const BodyPose> poses) {
  if (!poses.empty()) now_ = inOrder(poses.last(strandInGroom_.size()));
  oneStepEarlier_ = now_;
}

}  // namespace ringlet
