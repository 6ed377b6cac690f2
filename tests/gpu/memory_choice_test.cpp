// Where buffers are made, on memories as devices have them, some of them full.
#include "ringlet/gpu/memory_choice.h"

#include <gtest/gtest.h>

#include <tuple>

#include "tests/support/gpu_test.h"

namespace ringlet::gpu::memory_choice_test {
namespace {

constexpr VkMemoryPropertyFlags kLocal = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
constexpr VkMemoryPropertyFlags kCoherent =
    VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
constexpr VkMemoryPropertyFlags kCached = VK_MEMORY_PROPERTY_HOST_CACHED_BIT;
constexpr std::uint32_t kEvery = ~0u;
using Types = std::vector<std::uint32_t>;

VkPhysicalDeviceMemoryProperties memoryOf(const std::vector<std::uint64_t>& heaps,
                                          const std::vector<VkMemoryType>& types) {
  VkPhysicalDeviceMemoryProperties memory{};
  for (std::uint64_t size : heaps) memory.memoryHeaps[memory.memoryHeapCount++].size = size;
  for (const VkMemoryType& type : types) memory.memoryTypes[memory.memoryTypeCount++] = type;
  return memory;
}

// A graphics card: its own memory, the host's, and a window to its own.
const auto kCard = memoryOf({8000, 16000, 256}, {{kLocal, 0},
                                                 {kCoherent, 1},
                                                 {kLocal | kCoherent, 2},
                                                 {kCoherent | kCached, 1},
                                                 {kLocal | VK_MEMORY_PROPERTY_PROTECTED_BIT, 0}});
// A device that shares the host's memory.
const auto kShared = memoryOf({4000}, {{kLocal, 0}, {kLocal | kCoherent | kCached, 0}});

TEST(MemoryChoice, BestFirstAndEachHeapOnce) {
  EXPECT_EQ(memoryTypesFor(kCard, kEvery, BufferKind::storage, false), (Types{0, 2, 1}));
  EXPECT_EQ(memoryTypesFor(kCard, kEvery, BufferKind::stream, false), (Types{3, 2}));
  EXPECT_EQ(memoryTypesFor(kCard, 0b01000, BufferKind::storage, false), (Types{3})) << "as the driver allows";
  EXPECT_EQ(memoryTypesFor(kCard, 0b10000, BufferKind::storage, false), Types{}) << "protected";
  EXPECT_EQ(memoryTypesFor(kShared, kEvery, BufferKind::storage, false), (Types{1}));
  EXPECT_EQ(memoryTypesFor(kShared, kEvery, BufferKind::storage, true), (Types{0}));
  EXPECT_EQ(memoryTypesFor(kShared, kEvery, BufferKind::stream, true), (Types{1}));
  EXPECT_EQ(memoryTypesFor(kShared, 0b01, BufferKind::stream, false), Types{});
}

// Heaps have so many bytes left; counts calls.
struct Heaps {
  std::vector<std::uint64_t> left;
  VkResult otherwise = VK_ERROR_OUT_OF_DEVICE_MEMORY;
  int calls = 0;

  Result<std::uint32_t> make(std::uint64_t bytes) {
    const auto types = memoryTypesFor(kCard, kEvery, BufferKind::storage, false);
    return allocateInFirst(kCard, types, bytes, "make the buffer 'x'", [&](std::uint32_t type) {
      ++calls;
      return left[kCard.memoryTypes[type].heapIndex] >= bytes ? VK_SUCCESS : otherwise;
    });
  }
};

TEST(MemoryChoice, AFullHeapIsFollowedByTheNext) {
  for (const auto& [left, type, calls] : {std::tuple{std::vector<std::uint64_t>{8000, 16000, 256}, 0u, 1},
                                          std::tuple{std::vector<std::uint64_t>{50, 16000, 256}, 2u, 2},
                                          std::tuple{std::vector<std::uint64_t>{50, 16000, 99}, 1u, 3}}) {
    Heaps heaps{left};
    const auto made = heaps.make(100);
    ASSERT_TRUE(made) << made.error().message;
    EXPECT_EQ(*made, type);
    EXPECT_EQ(heaps.calls, calls);
  }
}

TEST(MemoryChoice, FailuresNameTheHeapsTried) {
  Heaps full{{50, 50, 50}};
  const auto none = full.make(100);
  ASSERT_FALSE(none);
  test::expectParts(none.error().message,
                    {"make the buffer 'x'", "heap 0 of 8000 bytes", "heap 2 of 256 bytes",
                     "heap 1 of 16000 bytes", "VK_ERROR_OUT_OF_DEVICE_MEMORY"});
  EXPECT_EQ(full.calls, 3);

  Heaps wide{{8000, 16000, 256}};
  const auto giant = wide.make(20000);
  ASSERT_FALSE(giant);
  test::expectParts(giant.error().message, {"larger than the whole memory", "heap 1 of 16000 bytes"});
  EXPECT_EQ(wide.calls, 0) << "the driver is not asked for what no heap can hold";

  Heaps broken{{50, 16000, 256}, VK_ERROR_TOO_MANY_OBJECTS};
  const auto refused = broken.make(100);
  ASSERT_FALSE(refused);
  test::expectParts(refused.error().message, {"VK_ERROR_TOO_MANY_OBJECTS"});
  EXPECT_EQ(broken.calls, 1) << "another heap does not help";
}

}  // namespace
}  // namespace ringlet::gpu::memory_choice_test
