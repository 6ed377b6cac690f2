// Which of a device's queue families the solver submits to.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "ringlet/gpu/vulkan.h"

namespace ringlet::gpu {

/// The index of the best family that computes; none where none does. In order of preference:
///   1. one without graphics that has timestamps: a long dispatch there does not freeze the desktop, and
///      drivers wait longer before they take it for a hang
///   2. one that has timestamps
///   3. any
/// Of several equals the first. `wantsGraphics`: only those that have graphics too.
std::optional<std::uint32_t> chooseComputeFamily(std::span<const VkQueueFamilyProperties> families,
                                                 bool wantsGraphics = false);

}  // namespace ringlet::gpu
