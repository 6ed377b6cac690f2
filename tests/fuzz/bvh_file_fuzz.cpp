// BVH files, and the ways of their joints.
#include "ringlet/motion/bvh_file.h"

#include <algorithm>

#include "ringlet/motion/motion_doubts.h"
#include "tests/fuzz/fuzz_target.h"

namespace ringlet::fuzz {

const MemoryBound kMemory{.base = 1 << 20, .perByte = 512};

void tryBytes(std::span<const std::byte> bytes) {
  const auto file = parseBvh(textOf(bytes));
  if (!file) return;
  demand(file->frameCount() > 0 && file->frameSeconds > 0 && !file->joints.empty(), "a motion has frames");
  demand(file->values.size() == file->frameCount() * file->channelCount, "a frame has its numbers");
  for (const double value : file->values) demand(std::isfinite(value), "all numbers are finite");
  for (std::size_t j = 0; j < file->joints.size(); ++j) {
    demand(file->joints[j].parent < j || (j == 0 && file->joints[j].parent == 0), "parents come first");
    demand(isFinite(file->joints[j].offset), "all offsets are finite");
  }
  demand(file->frameCount() == std::min(file->statedFrameCount, file->foundFrameCount), "frames are counted");
  const BvhStance stance = stanceOf(*file, 0, {});
  demand(stance.height >= 0 && unitOf(stance) > 0, "a person has a height, and its file a unit");
  doubtsOf(*file, stance, "", {}, false);
  doubtsOf(*file, stance, "", 1.0, true);
  const std::size_t last = file->joints.size() - 1;
  const Keyframes keys = file->motionOf(last, 0.01, 0);
  demand(keys.poses.size() == file->frameCount(), "a joint has a pose a frame");
  keys.poseAt(keys.seconds() / 2);
}

}  // namespace ringlet::fuzz
