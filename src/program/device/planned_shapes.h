// The strand shapes that a device's plan chooses for hair of usual lengths.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "ringlet/solver/plan/shape_plan.h"

namespace ringlet::program {

/// Particles a strand of usual hair.
inline constexpr std::uint32_t kUsualLengths[] = {16, 32, 64, 128, 256};

/// Without repetition, by rising capacity, what is planned for grooms of each of these lengths: of
/// 1.5 million particles, and, where `alsoFew`, of a hundred strands too, which get kernels that
/// are sooner made.
std::vector<StrandShape> plannedShapes(const DeviceLimits& limits, StrandWork work,
                                       std::span<const std::uint32_t> lengths = kUsualLengths,
                                       bool alsoFew = false);

}  // namespace ringlet::program
