// How a groom's ranges (shape_plan.h) are cut into dispatches: how many steps each may do. Pure arithmetic,
// no device.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/scene/settings.h"
#include "ringlet/solver/shape_plan.h"

namespace ringlet {

/// One dispatch of a frame.
struct PlannedDispatch {
  std::uint32_t range = 0;  // index into the ranges
  std::uint32_t strandBegin = 0, strandEnd = 0;
  std::uint32_t stepBegin = 0, stepEnd = 0;
  std::uint32_t phases = 0;  // layout/strands.h: kPhaseMove, kPhaseContacts
  std::uint32_t groupCount = 0;
};

/// Workgroups of a dispatch for so many heads.
std::uint32_t groupCountOf(const PlannedDispatch& dispatch, const StrandShape& shape, std::uint32_t groupSize,
                           std::uint32_t heads = 1);

/// One solve with contacts on: which step, what it does, and whether it goes on to the next step's first
/// solve.
struct SolvePass {
  std::uint32_t step = 0;
  bool withContacts = false;  // else the first solve, without
  bool moves = false;         // it is the step's last
  bool goesOn = false;        // and the first of the step after follows
};

/// No bound on a dispatch but the device's.
inline constexpr std::uint64_t kAnyParticleSteps = ~std::uint64_t{0};

/// Particles of a dispatch, as long as its range's longest strand, times its steps.
std::uint64_t particleStepsOf(const PlannedDispatch& dispatch, std::span<const StrandRange> ranges);

/// Whether the later of two dispatches that follow each other needs what the earlier one wrote. Others may
/// run at the same time.
bool sharesStrands(const PlannedDispatch& a, const PlannedDispatch& b);

/// The dispatches of one pass, in order, as for planFrame. Fails where a step is too long for the device.
Result<std::vector<PlannedDispatch>> planPass(std::span<const StrandRange> ranges, const DeviceLimits& limits,
                                              const Settings& settings, std::size_t bodyCount,
                                              std::uint32_t groupSize, const SolvePass& pass,
                                              std::uint64_t mostParticleSteps = kAnyParticleSteps);

/// The dispatches of one frame, in order; those of one range depend on each other, those of different ranges
/// do not. None has more than `mostParticleSteps`, but for one step of a workgroup. Fails where a step cannot
/// be cut small enough for the device.
Result<std::vector<PlannedDispatch>> planFrame(std::span<const StrandRange> ranges,
                                               const DeviceLimits& limits, const Settings& settings,
                                               std::size_t bodyCount, std::uint32_t groupSize,
                                               std::uint64_t mostParticleSteps = kAnyParticleSteps);

}  // namespace ringlet
