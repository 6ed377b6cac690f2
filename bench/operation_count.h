// How much arithmetic a step is, counted by running the hand-vectorised loop's own code on numbers that
// count.
#pragma once

#include <cstdint>

#include "bench/hand_sweeps.h"

namespace ringlet::bench {

/// Floating-point operations of runBlock for one strand of block.longest particles: an addition, subtraction,
/// multiplication, division and square root count one each; minimum, maximum, comparison, negation and moves
/// none. The same number is taken for every implementation of the step, whatever it does beside.
std::uint64_t countOperations(const SweepRun& run, const Block& block);

}  // namespace ringlet::bench
