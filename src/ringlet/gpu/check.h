// From a VkResult to an Error that a person can read: what was attempted, which call failed, and how.
#pragma once

#include <string>
#include <string_view>

#include "ringlet/base/result.h"
#include "ringlet/gpu/vulkan.h"

namespace ringlet::gpu {

/// "VK_ERROR_DEVICE_LOST" and the like; "VkResult 123" for one not known here.
std::string resultName(VkResult result);

/// "could not <attempt>: vkAllocateMemory failed with VK_ERROR_...", and advice where there is some.
/// `call` is the call's text; its name is cut out of it.
Error vulkanError(std::string_view call, VkResult result, std::string_view attempt);

}  // namespace ringlet::gpu

// Returns an Error from the enclosing function unless the call gives VK_SUCCESS. `attempt` completes "could
// not ..."; it is evaluated only on failure.
#define RINGLET_VK_CHECK(call, attempt)                                     \
  do {                                                                      \
    if (const VkResult checkedResult = (call); checkedResult != VK_SUCCESS) \
      return ::ringlet::gpu::vulkanError(#call, checkedResult, attempt);    \
  } while (false)
