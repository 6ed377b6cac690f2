// Cuts the ranges of a groom (shape_plan.h) into dispatches, by the number of steps each may do. Pure
// arithmetic, no device.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/scene/settings.h"
#include "ringlet/solver/plan/shape_plan.h"

namespace ringlet {

/// One dispatch of a frame.
struct PlannedDispatch {
  std::uint32_t range = 0;  // index into the ranges
  std::uint32_t strandBegin = 0, strandEnd = 0;
  std::uint32_t stepBegin = 0, stepEnd = 0;
  std::uint32_t phases = 0;  // layout/strands.h: kPhaseMove, kPhaseContacts
  std::uint32_t groupCount = 0;
};

/// Number of workgroups of a dispatch over this many heads.
std::uint32_t groupCountOf(const PlannedDispatch& dispatch, const StrandShape& shape, std::uint32_t groupSize,
                           std::uint32_t heads = 1);

/// One solve of a step with contacts.
struct SolvePass {
  std::uint32_t step = 0;
  bool withContacts = false;  // false: the step's first solve
  bool moves = false;         // the last solve of the step: strands move after it
  bool goesOn = false;        // the first solve of the next step follows in the same dispatch
};

/// No limit on a dispatch besides the device's.
inline constexpr std::uint64_t kAnyParticleSteps = ~std::uint64_t{0};

/// Loop turns that a lane may spend on cloth in a dispatch: its share of all, for a CPU driver counts the
/// turns of the lanes of a subgroup together.
std::uint32_t clothTurns(const DeviceLimits& limits);

/// What a dispatch may be.
struct DispatchRoom {
  const DeviceLimits& limits;
  std::uint32_t groupSize;
  std::uint64_t mostParticleSteps = kAnyParticleSteps;
};

/// Particle steps of a dispatch: its strands times the particles of the range's longest strand times its
/// steps.
std::uint64_t particleStepsOf(const PlannedDispatch& dispatch, std::span<const StrandRange> ranges);

/// Whether the later of two consecutive dispatches reads the results of the earlier one. If not, they may run
/// at the same time.
bool sharesStrands(const PlannedDispatch& a, const PlannedDispatch& b);

/// The dispatches of one solve pass, in order, as planFrame's. Fails if a step is too long for the device.
Result<std::vector<PlannedDispatch>> planPass(std::span<const StrandRange> ranges, const DispatchRoom& room,
                                              const Settings& settings, std::size_t bodyCount,
                                              const SolvePass& pass);

/// The dispatches of one frame, in order; those of one range depend on each other, those of different ranges
/// do not. None has more than `room.mostParticleSteps`, but for one step of a workgroup. Fails where a step
/// cannot be cut small enough for the device.
Result<std::vector<PlannedDispatch>> planFrame(std::span<const StrandRange> ranges, const DispatchRoom& room,
                                               const Settings& settings, std::size_t bodyCount);

}  // namespace ringlet
