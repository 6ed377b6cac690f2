// Implements solver/device_roots.h.
#include "ringlet/solver/device_roots.h"

#include <algorithm>
#include <utility>

#include "ringlet/base/assert.h"

namespace ringlet {
namespace {

using gpu::Buffer;
using gpu::BufferKind;

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
                                        bool areMoving, std::span<const GroomChunk> chunks) {
  const std::uint64_t strands = areMoving ? rest.strands.size() : 0;
  DeviceRoots roots(settings.stepSeconds());
  roots.chunks_.assign(chunks.begin(), chunks.end());
  for (const GroomChunk& chunk : chunks) {
    const std::uint64_t poses =
        areMoving ? (static_cast<std::uint64_t>(settings.stepsPerFrame) + 1) * chunk.strandCount() : 0;
    auto buffer = Buffer::create(device, poses * sizeof(layout::RootPose), BufferKind::stream, "root poses");
    if (!buffer) return buffer.error();
    roots.poses_.push_back(std::move(*buffer));
  }
  if (areMoving) roots.strandInGroom_.assign(rest.strandInGroom.begin(), rest.strandInGroom.end());
  roots.now_.resize(strands);
  roots.oneStepEarlier_.resize(strands);
  return roots;
}

std::uint64_t DeviceRoots::largestBuffer() const {
  std::uint64_t largest = 0;
  for (const Buffer& poses : poses_) largest = std::max(largest, poses.bytes());
  return largest;
}
std::uint64_t DeviceRoots::bytes() const {
  std::uint64_t bytes = 0;
  for (const Buffer& poses : poses_) bytes += poses.bytes();
  return bytes;
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

void DeviceRoots::writeFrame(std::span<const HeadPose> heads, std::span<const BodyPose> poses) {
  const std::size_t count = now_.size();
  RINGLET_ASSERT(poses.empty() || poses.size() == (heads.size() - 2) * count,
                 "every strand has a pose in every step");
  if (count == 0) return;
  std::vector<BodyPose> before(count);  // what carried the strand one pose earlier
  for (std::size_t s = 0; s < count; ++s) before[s] = carriedBy(heads[0].rotation, oneStepEarlier_[s]);
  for (std::size_t pose = 0; pose + 1 < heads.size(); ++pose) {
    if (pose > 0) {
      std::vector<BodyPose> next = poses.empty() ? now_ : inOrder(poses.subspan((pose - 1) * count, count));
      oneStepEarlier_ = std::exchange(now_, std::move(next));
    }
    const Quatd head = normalized(heads[pose + 1].rotation);
    for (std::size_t c = 0; c < chunks_.size(); ++c) {
      auto out =
          reinterpret_cast<layout::RootPose*>(poses_[c].mapped().data()) + pose * chunks_[c].strandCount();
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

void DeviceRoots::endFrame(std::span<const BodyPose> poses) {
  if (!poses.empty()) now_ = inOrder(poses.last(strandInGroom_.size()));
  oneStepEarlier_ = now_;
}

}  // namespace ringlet
