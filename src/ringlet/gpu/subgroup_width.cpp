// Implements gpu/subgroup_width.h.
#include "ringlet/gpu/subgroup_width.h"

#include <algorithm>
#include <bit>

namespace ringlet::gpu {
namespace {

constexpr std::uint32_t kAmd = 0x1002, kIntel = 0x8086;  // vendors' numbers, as PCI has them
constexpr std::uint32_t kAmdWidth = 32;                  // of gfx10 and later; before it was 64 alone

}  // namespace

std::uint32_t defaultSubgroupSize(const DeviceProperties& stated) {
  const std::uint32_t reported = stated.reportedSubgroupSize;
  if (!stated.canChooseSubgroupSize) return reported;
  if (stated.vendorId == kIntel) return stated.minSubgroupSize;
  if (stated.vendorId == kAmd && reported > kAmdWidth && hasSubgroupSize(stated, kAmdWidth)) return kAmdWidth;
  const std::uint32_t widest = std::min(stated.maxSubgroupSize, kNeededGroupInvocations);
  return std::max(stated.minSubgroupSize, std::min(reported, widest));
}

bool hasSubgroupSize(const DeviceProperties& properties, std::uint32_t width) {
  if (!properties.canChooseSubgroupSize) return width == properties.reportedSubgroupSize;
  return std::has_single_bit(width) && properties.minSubgroupSize <= width &&
         width <= properties.maxSubgroupSize;
}

}  // namespace ringlet::gpu
