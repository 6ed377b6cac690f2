// The queue family the solver takes, of families as devices have them.
#include "ringlet/gpu/queue_family.h"

#include <gtest/gtest.h>

#include <vector>

namespace ringlet::gpu::queue_family_test {
namespace {

VkQueueFamilyProperties family(VkQueueFlags flags, std::uint32_t timestampBits, std::uint32_t count = 1) {
  VkQueueFamilyProperties properties{};
  properties.queueFlags = flags;
  properties.queueCount = count;
  properties.timestampValidBits = timestampBits;
  return properties;
}

constexpr VkQueueFlags kAll = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT | VK_QUEUE_TRANSFER_BIT;
constexpr VkQueueFlags kCompute = VK_QUEUE_COMPUTE_BIT | VK_QUEUE_TRANSFER_BIT;
constexpr VkQueueFlags kGraphics = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_TRANSFER_BIT;

TEST(QueueFamily, ComputesWithoutGraphicsAndHasTimestamps) {
  struct Case {
    const char* of;
    std::vector<VkQueueFamilyProperties> families;
    std::optional<std::uint32_t> chosen;
  };
  for (const Case& c : {
           Case{"no family", {}, std::nullopt},
           Case{"none that computes",
                {family(kGraphics, 64), family(VK_QUEUE_TRANSFER_BIT, 64)},
                std::nullopt},
           Case{"lavapipe: one that does all", {family(kAll, 64)}, 0},
           Case{"RADV: all, compute, copies",
                {family(kAll, 64), family(kCompute, 64, 4), family(VK_QUEUE_TRANSFER_BIT, 64)},
                1},
           Case{"NVIDIA: all, copies, compute",
                {family(kAll, 64, 16), family(VK_QUEUE_TRANSFER_BIT, 64, 2), family(kCompute, 64, 8)},
                2},
           Case{"compute comes first", {family(kCompute, 64), family(kAll, 64)}, 0},
           Case{"compute without timestamps", {family(kAll, 64), family(kCompute, 0)}, 0},
           Case{"timestamps only in the second", {family(kAll, 0), family(kAll, 36)}, 1},
           Case{"no timestamps at all", {family(kGraphics, 0), family(kAll, 0), family(kCompute, 0)}, 1},
           Case{"two alike", {family(kAll, 64), family(kCompute, 64), family(kCompute, 64)}, 1},
           Case{"a family without queues", {family(kCompute, 64, 0), family(kAll, 64)}, 1},
       }) {
    EXPECT_EQ(chooseComputeFamily(c.families), c.chosen) << c.of;
  }
}

}  // namespace
}  // namespace ringlet::gpu::queue_family_test
