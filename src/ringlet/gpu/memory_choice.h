// The memory types that a buffer may be made in, best first, and the fallback if one is full.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/gpu/buffer.h"
#include "ringlet/gpu/vulkan.h"

namespace ringlet::gpu {

/// Memory types a buffer of this kind can be in, best first, each heap once: one that is full for one of its
/// types is full for all. `allowed`: a bit a type, as the driver gives it. A stream is in coherent memory,
/// cached if possible; storage in the device's own, and in the host's where there is none or it is full.
std::vector<std::uint32_t> memoryTypesFor(const VkPhysicalDeviceMemoryProperties& memory,
                                          std::uint32_t allowed, BufferKind kind, bool alwaysStage);

/// Calls `allocate` with one type after the other, until one has room for so many bytes, and returns that
/// type. Fails with a list of the heaps tried, at once where the reason is not a full heap. `attempt`
/// completes "could not ...".
Result<std::uint32_t> allocateInFirst(const VkPhysicalDeviceMemoryProperties& memory,
                                      const std::vector<std::uint32_t>& types, std::uint64_t bytes,
                                      const std::string& attempt,
                                      const std::function<VkResult(std::uint32_t type)>& allocate);

}  // namespace ringlet::gpu
