// The strand shapes that a device's plan chooses for hair of usual lengths.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "ringlet/solver/plan/shape_plan.h"

namespace ringlet::program {

/// Numbers of particles in a strand of usual hair.
inline constexpr std::uint32_t kUsualLengths[] = {16, 32, 64, 128, 256};

/// The shapes planned for grooms of each of these lengths, without repetition, by rising capacity: for grooms
/// of 1.5 million particles and, if `alsoFew`, also of a hundred strands, which get kernels that compile
/// sooner.
std::vector<StrandShape> plannedShapes(const DeviceLimits& limits, StrandWork work,
                                       std::span<const std::uint32_t> lengths = kUsualLengths,
                                       bool alsoFew = false);

}  // namespace ringlet::program
