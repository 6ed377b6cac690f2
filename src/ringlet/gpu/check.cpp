// Implements gpu/check.h.
#include "ringlet/gpu/check.h"

#include <utility>

#include <fmt/format.h>

namespace ringlet::gpu {
namespace {

// "device.vk().vkAllocateMemory(a, b)" -> "vkAllocateMemory"
std::string_view callName(std::string_view call) {
  std::size_t begin = 0;
  while ((begin = call.find("vk", begin)) != std::string_view::npos) {
    if (begin + 2 < call.size() && call[begin + 2] >= 'A' && call[begin + 2] <= 'Z') {
      return call.substr(begin, call.find('(', begin) - begin);
    }
    begin += 2;
  }
  return call;
}

// Those our calls can give.
constexpr std::pair<VkResult, const char*> kResultNames[] = {
    {VK_SUCCESS, "VK_SUCCESS"},
    {VK_NOT_READY, "VK_NOT_READY"},
    {VK_TIMEOUT, "VK_TIMEOUT"},
    {VK_INCOMPLETE, "VK_INCOMPLETE"},
    {VK_ERROR_OUT_OF_HOST_MEMORY, "VK_ERROR_OUT_OF_HOST_MEMORY"},
    {VK_ERROR_OUT_OF_DEVICE_MEMORY, "VK_ERROR_OUT_OF_DEVICE_MEMORY"},
    {VK_ERROR_INITIALIZATION_FAILED, "VK_ERROR_INITIALIZATION_FAILED"},
    {VK_ERROR_DEVICE_LOST, "VK_ERROR_DEVICE_LOST"},
    {VK_ERROR_MEMORY_MAP_FAILED, "VK_ERROR_MEMORY_MAP_FAILED"},
    {VK_ERROR_LAYER_NOT_PRESENT, "VK_ERROR_LAYER_NOT_PRESENT"},
    {VK_ERROR_EXTENSION_NOT_PRESENT, "VK_ERROR_EXTENSION_NOT_PRESENT"},
    {VK_ERROR_FEATURE_NOT_PRESENT, "VK_ERROR_FEATURE_NOT_PRESENT"},
    {VK_ERROR_INCOMPATIBLE_DRIVER, "VK_ERROR_INCOMPATIBLE_DRIVER"},
    {VK_ERROR_TOO_MANY_OBJECTS, "VK_ERROR_TOO_MANY_OBJECTS"},
    {VK_ERROR_FRAGMENTED_POOL, "VK_ERROR_FRAGMENTED_POOL"},
    {VK_ERROR_OUT_OF_POOL_MEMORY, "VK_ERROR_OUT_OF_POOL_MEMORY"},
    {VK_ERROR_FRAGMENTATION, "VK_ERROR_FRAGMENTATION"},
    {VK_ERROR_INVALID_SHADER_NV, "VK_ERROR_INVALID_SHADER_NV"},
    {VK_ERROR_UNKNOWN, "VK_ERROR_UNKNOWN"},
};

const char* advice(VkResult result) {
  switch (result) {
    case VK_ERROR_DEVICE_LOST:
      return ". The driver gave up on the device: mostly a dispatch that outran the driver's time limit, or "
             "a fault of the driver. Open the device anew, with less work in one submission";
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
      return ". The device's memory is full: free some, or ask for less";
    case VK_ERROR_OUT_OF_HOST_MEMORY:
      return ". The host's memory is full";
    case VK_ERROR_TOO_MANY_OBJECTS:
      return ". Too many buffers are alive at once";
    default:
      return "";
  }
}

Fault faultOf(VkResult result) {
  switch (result) {
    case VK_ERROR_DEVICE_LOST:
      return Fault::deviceLost;
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
      return Fault::deviceMemory;
    case VK_ERROR_OUT_OF_HOST_MEMORY:
      return Fault::hostMemory;
    default:
      return Fault::other;
  }
}

}  // namespace

std::string resultName(VkResult result) {
  for (const auto& [value, name] : kResultNames) {
    if (value == result) return name;
  }
  return fmt::format("VkResult {}", static_cast<int>(result));
}

Error vulkanError(std::string_view call, VkResult result, std::string_view attempt) {
  return {fmt::format("could not {}: {} failed with {}{}", attempt, callName(call), resultName(result),
                      advice(result)),
          faultOf(result)};
}

}  // namespace ringlet::gpu
