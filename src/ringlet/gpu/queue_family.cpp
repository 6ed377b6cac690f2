// Implements gpu/queue_family.h.
#include "ringlet/gpu/queue_family.h"

namespace ringlet::gpu {
namespace {

// 0: does not compute; else the more the better.
int worthOf(const VkQueueFamilyProperties& family) {
  const bool canCompute = (family.queueFlags & VK_QUEUE_COMPUTE_BIT) != 0;
  const bool hasGraphics = (family.queueFlags & VK_QUEUE_GRAPHICS_BIT) != 0;
  const bool hasTimestamps = family.timestampValidBits > 0;
  if (!canCompute || family.queueCount == 0) return 0;
  return !hasTimestamps ? 1 : hasGraphics ? 2 : 3;
}

}  // namespace

std::optional<std::uint32_t> chooseComputeFamily(std::span<const VkQueueFamilyProperties> families,
                                                 bool wantsGraphics) {
  std::optional<std::uint32_t> best;
  int bestWorth = 0;
  for (std::uint32_t i = 0; i < families.size(); ++i) {
    if (wantsGraphics && !(families[i].queueFlags & VK_QUEUE_GRAPHICS_BIT)) continue;
    const int worth = worthOf(families[i]);
    if (worth > bestWorth) best = i, bestWorth = worth;
  }
  return best;
}

}  // namespace ringlet::gpu
