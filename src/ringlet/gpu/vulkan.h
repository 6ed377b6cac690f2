// Vulkan by way of volk, which finds the loader at run time: a program with ringlet in it starts without
// Vulkan too. Calls that take a device go through Device::vk(), a table of its own driver's functions; the
// rest are volk's globals.
#pragma once

#include "ringlet/gpu/volk_names.h"

#include <volk.h>

namespace ringlet::gpu {

/// One of Vulkan's structs with its type set and all else zero.
template <class Info>
Info zeroed(VkStructureType type) {
  Info info{};
  info.sType = type;
  return info;
}

}  // namespace ringlet::gpu
