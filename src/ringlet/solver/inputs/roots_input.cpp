// Implements solver/inputs/roots_input.h.
#include "ringlet/solver/inputs/roots_input.h"

#include <utility>

#include "ringlet/base/assert.h"
#include "ringlet/base/packed.h"
#include "ringlet/solver/diagnostics.h"
#include "ringlet/solver/inputs/frame_inputs.h"

namespace ringlet {

BodyPose carriedBy(Quatd headRotation, const BodyPose& root) {
  return {rotate(headRotation, root.position), headRotation * root.rotation};
}

Result<RootsInput> RootsInput::create(const InputSource& from) {
  RootsInput self;
  self.chunks_ = from.chunks;
  self.groomStrandCount_ = from.rest.groomStrandCount;
  if (Status status = self.prepare(from); !status) return status.error();
  if (from.initial.roots.empty()) return self;
  self.now_ = self.inOrder(from.initial.roots);
  self.oneStepEarlier_ = self.inOrder(from.initial.rootsEarlier);
  return self;
}

Status RootsInput::prepare(const InputSource& from) {
  if (areMoving_ == from.features.roots && !staged_.empty()) return {};
  areMoving_ = from.features.roots;
  staged_.clear();
  for (const GroomChunk& chunk : chunks_) {
    const auto steps = static_cast<std::uint64_t>(from.settings.stepsPerFrame);
    const std::uint64_t poses = areMoving_ ? (steps + 1) * chunk.strandCount() : 0;
    if (Status status = stage(from, poses * sizeof(layout::RootPose), "root poses"); !status) return status;
  }
  if (!areMoving_) return {};
  strandInGroom_.assign(from.rest.strandInGroom.begin(), from.rest.strandInGroom.end());
  now_.resize(from.rest.strands.size());
  oneStepEarlier_.resize(from.rest.strands.size());
  return {};
}

std::vector<BodyPose> RootsInput::inOrder(std::span<const BodyPose> poses) const {
  RINGLET_ASSERT(areMoving(), "poses of roots of hair without the feature roots");
  RINGLET_ASSERT(poses.size() == groomStrandCount_, "every strand has a pose in every step");
  std::vector<BodyPose> ordered;
  ordered.reserve(strandInGroom_.size());
  for (const std::uint32_t strand : strandInGroom_)
    ordered.push_back({poses[strand].position, normalized(poses[strand].rotation)});
  return ordered;
}

void RootsInput::rescale(double share) {
  for (std::size_t s = 0; s < now_.size(); ++s)
    oneStepEarlier_[s] = interpolate(now_[s], oneStepEarlier_[s], share);
}

void RootsInput::writeFrame(std::size_t slot, const FrameContext& frame) {
  const std::span<const HeadPose> heads = frame.heads;
  const std::span<const BodyPose> poses = frame.rootPoses;
  const std::size_t count = now_.size();
  RINGLET_ASSERT(poses.empty() || poses.size() == frame.steps() * groomStrandCount_,
                 "every strand has a pose in every step");
  if (count == 0) return;
  std::vector<BodyPose> before(count);  // the pose that carried each strand one pose earlier
  for (std::size_t s = 0; s < count; ++s) before[s] = carriedBy(heads[0].rotation, oneStepEarlier_[s]);
  for (std::size_t pose = 0; pose + 1 < heads.size(); ++pose) {
    if (pose > 0) {
      const std::size_t first = (pose - 1) * groomStrandCount_;
      std::vector<BodyPose> next = poses.empty() ? now_ : inOrder(poses.subspan(first, groomStrandCount_));
      oneStepEarlier_ = std::exchange(now_, std::move(next));
    }
    const Quatd head = normalized(heads[pose + 1].rotation);
    for (std::size_t c = 0; c < chunks_.size(); ++c) {
      layout::RootPose* out = &staged_[c].of<layout::RootPose>(slot)[pose * chunks_[c].strandCount()];
      for (std::size_t s = chunks_[c].strandBegin; s < chunks_[c].strandEnd; ++s) {
        const BodyPose now = carriedBy(head, now_[s]);
        const Quatd turn = now.rotation * before[s].rotation.conjugate();
        const Vec3d velocity = (now.position - before[s].position) / frame.stepSeconds;
        *out++ = {packed(now.position), packed(now.rotation), packed(turn), packed(velocity)};
        before[s] = now;
      }
    }
  }
}

bool RootsInput::isQuiet(const FrameContext& frame) const {
  if (now_ != oneStepEarlier_) return false;
  for (std::size_t first = 0; first < frame.rootPoses.size(); first += groomStrandCount_)
    if (inOrder(frame.rootPoses.subspan(first, groomStrandCount_)) != now_) return false;
  return true;
}

// Sets roots to their last poses, at rest relative to the head.
void RootsInput::jump(const FrameContext& frame) {
  if (!frame.rootPoses.empty()) now_ = inOrder(frame.rootPoses.last(groomStrandCount_));
  oneStepEarlier_ = now_;
}

Status RootsInput::archive(Archive& archive) {
  archive.values(std::span(now_));
  archive.values(std::span(oneStepEarlier_));
  return {};
}

gpu::BufferTable RootsInput::bufferTable(std::size_t chunk) const {
  return {{layout::kBindRootPoses, staged_[chunk].seen()},
          {layout::kBindRootPoseTexels, staged_[chunk].seen()}};
}

std::uint64_t DeviceMemory::*RootsInput::kind() const { return &DeviceMemory::rootPoses; }

}  // namespace ringlet
