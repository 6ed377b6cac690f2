// Implements solver/inputs/device_roots.h.
#include "ringlet/solver/inputs/device_roots.h"

#include <utility>

#include "ringlet/base/assert.h"
#include "ringlet/base/packed.h"

namespace ringlet {

BodyPose carriedBy(Quatd headRotation, const BodyPose& root) {
  return {rotate(headRotation, root.position), headRotation * root.rotation};
}

Result<DeviceRoots> DeviceRoots::create(gpu::Device& device, const RestState& rest, const Settings& settings,
                                        bool areMoving, std::span<const GroomChunk> chunks,
                                        std::size_t slots) {
  const std::uint64_t strands = areMoving ? rest.strands.size() : 0;
  DeviceRoots roots(settings.stepSeconds(), areMoving, rest.groomStrandCount);
  roots.chunks_.assign(chunks.begin(), chunks.end());
  for (const GroomChunk& chunk : chunks) {
    const std::uint64_t poses =
        areMoving ? (static_cast<std::uint64_t>(settings.stepsPerFrame) + 1) * chunk.strandCount() : 0;
    auto input = FrameInput::create(device, poses * sizeof(layout::RootPose), slots, "root poses");
    if (!input) return input.error();
    roots.poses_.push_back(std::move(*input));
  }
  if (areMoving) roots.strandInGroom_.assign(rest.strandInGroom.begin(), rest.strandInGroom.end());
  roots.now_.resize(strands);
  roots.oneStepEarlier_.resize(strands);
  return roots;
}

std::vector<BodyPose> DeviceRoots::inOrder(std::span<const BodyPose> poses) const {
  RINGLET_ASSERT(areMoving(), "strands have poses of their own only with KernelChoice::movingRoots");
  RINGLET_ASSERT(poses.size() == groomStrandCount_, "every strand has a pose in every step");
  std::vector<BodyPose> ordered;
  ordered.reserve(strandInGroom_.size());
  for (const std::uint32_t strand : strandInGroom_)
    ordered.push_back({poses[strand].position, normalized(poses[strand].rotation)});
  return ordered;
}

void DeviceRoots::setStepSeconds(double seconds) {
  for (std::size_t s = 0; s < now_.size(); ++s)
    oneStepEarlier_[s] = interpolate(now_[s], oneStepEarlier_[s], seconds / stepSeconds_);
  stepSeconds_ = seconds;
}

void DeviceRoots::place(std::span<const BodyPose> now, std::span<const BodyPose> oneStepEarlier) {
  now_ = inOrder(now);
  oneStepEarlier_ = inOrder(oneStepEarlier);
}

void DeviceRoots::writeFrame(std::size_t slot, std::span<const HeadPose> heads,
                             std::span<const BodyPose> poses) {
  const std::size_t count = now_.size();
  RINGLET_ASSERT(poses.empty() || poses.size() == (heads.size() - 2) * groomStrandCount_,
                 "every strand has a pose in every step");
  if (count == 0) return;
  std::vector<BodyPose> before(count);  // the pose that carried the strand one pose earlier
  for (std::size_t s = 0; s < count; ++s) before[s] = carriedBy(heads[0].rotation, oneStepEarlier_[s]);
  for (std::size_t pose = 0; pose + 1 < heads.size(); ++pose) {
    if (pose > 0) {
      const std::size_t first = (pose - 1) * groomStrandCount_;
      std::vector<BodyPose> next = poses.empty() ? now_ : inOrder(poses.subspan(first, groomStrandCount_));
      oneStepEarlier_ = std::exchange(now_, std::move(next));
    }
    const Quatd head = normalized(heads[pose + 1].rotation);
    for (std::size_t c = 0; c < chunks_.size(); ++c) {
      layout::RootPose* out = &poses_[c].of<layout::RootPose>(slot)[pose * chunks_[c].strandCount()];
      for (std::size_t s = chunks_[c].strandBegin; s < chunks_[c].strandEnd; ++s) {
        const BodyPose now = carriedBy(head, now_[s]);
        const Quatd turn = now.rotation * before[s].rotation.conjugate();
        const Vec3d velocity = (now.position - before[s].position) / stepSeconds_;
        *out++ = {packed(now.position), packed(now.rotation), packed(turn), packed(velocity)};
        before[s] = now;
      }
    }
  }
}

bool DeviceRoots::areStill(std::span<const BodyPose> poses) const {
  if (now_ != oneStepEarlier_) return false;
  for (std::size_t first = 0; first < poses.size(); first += groomStrandCount_)
    if (inOrder(poses.subspan(first, groomStrandCount_)) != now_) return false;
  return true;
}

void DeviceRoots::endFrame(std::span<const BodyPose> poses) {
  if (!poses.empty()) now_ = inOrder(poses.last(groomStrandCount_));
  oneStepEarlier_ = now_;
}

}  // namespace ringlet
