// Implements gpu/memory_choice.h.
#include "ringlet/gpu/memory_choice.h"

#include <fmt/format.h>

#include <algorithm>

#include "ringlet/gpu/check.h"

namespace ringlet::gpu {
namespace {

constexpr VkMemoryPropertyFlags kLocal = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
constexpr VkMemoryPropertyFlags kCoherent =
    VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
constexpr VkMemoryPropertyFlags kCoherentCached = kCoherent | VK_MEMORY_PROPERTY_HOST_CACHED_BIT;

// Kinds of memory that need features or are not for buffers.
constexpr VkMemoryPropertyFlags kUnwanted = VK_MEMORY_PROPERTY_PROTECTED_BIT |
                                            VK_MEMORY_PROPERTY_LAZILY_ALLOCATED_BIT |
                                            VK_MEMORY_PROPERTY_DEVICE_COHERENT_BIT_AMD;

// What a memory must be, best first. Storage is mapped only where the host caches it (integrated and CPU
// devices): through the window a graphics card opens to its memory, reading is slower than a copy, and the
// window may be small.
std::vector<VkMemoryPropertyFlags> wishesOf(BufferKind kind, bool alwaysStage) {
  if (kind == BufferKind::stream) return {kCoherentCached, kCoherent};
  if (alwaysStage) return {kLocal, 0};
  return {kLocal | kCoherentCached, kLocal, 0};
}

}  // namespace

std::vector<std::uint32_t> memoryTypesFor(const VkPhysicalDeviceMemoryProperties& memory,
                                          std::uint32_t allowed, BufferKind kind, bool alwaysStage) {
  std::vector<std::uint32_t> types;
  const auto heapOf = [&](std::uint32_t type) { return memory.memoryTypes[type].heapIndex; };
  for (const VkMemoryPropertyFlags wanted : wishesOf(kind, alwaysStage)) {
    for (std::uint32_t i = 0; i < memory.memoryTypeCount; ++i) {
      const VkMemoryPropertyFlags flags = memory.memoryTypes[i].propertyFlags;
      const bool isSuitable =
          (allowed >> i & 1) != 0 && (flags & wanted) == wanted && (flags & kUnwanted) == 0;
      const bool isNewHeap = std::ranges::find(types, heapOf(i), heapOf) == types.end();
      if (isSuitable && isNewHeap) types.push_back(i);
    }
  }
  return types;
}

Result<std::uint32_t> allocateInFirst(const VkPhysicalDeviceMemoryProperties& memory,
                                      const std::vector<std::uint32_t>& types, std::uint64_t bytes,
                                      const std::string& attempt,
                                      const std::function<VkResult(std::uint32_t type)>& allocate) {
  std::string tried;
  bool fitsSome = false;
  VkResult last = VK_ERROR_OUT_OF_DEVICE_MEMORY;
  for (const std::uint32_t type : types) {
    const std::uint32_t heap = memory.memoryTypes[type].heapIndex;
    const std::uint64_t heapBytes = memory.memoryHeaps[heap].size;
    tried += fmt::format("{}heap {} of {} bytes", tried.empty() ? "" : ", ", heap, heapBytes);
    if (bytes > heapBytes) continue;
    fitsSome = true;
    last = allocate(type);
    if (last == VK_SUCCESS) return type;
    if (last != VK_ERROR_OUT_OF_DEVICE_MEMORY) break;
  }
  if (!fitsSome)
    return Error{
        fmt::format(
            "could not {}: it is larger than the whole memory for it ({}). Use less data, or another device",
            attempt, tried),
        Fault::deviceMemory};
  return vulkanError("vkAllocateMemory", last, fmt::format("{} (tried {})", attempt, tried));
}

}  // namespace ringlet::gpu
