// Implements solver/dispatch_plan.h.
#include "ringlet/solver/dispatch_plan.h"

#include <fmt/format.h>

#include <algorithm>

#include "shared/layout.h"

namespace ringlet {
namespace {

// A little below where such a device ends loops. Others have no such limit; theirs is a dispatch short enough
// not to be taken for a hang.
std::uint64_t loopBudget(const DeviceLimits& limits) { return limits.endsLoopsEarly ? 65000 : 4'000'000; }

// Turns of loops, at most: what one step costs besides its solve's outer loops, and what one of those costs.
struct LoopCost {
  std::uint64_t step = 0;
  std::uint64_t perSolveLoop = 0;
  std::uint64_t solveLoops = 0;
};

LoopCost loopCost(const StrandRange& range, const Settings& settings, std::size_t bodyCount) {
  // Lanes: loops over the run count in full, though drivers unroll them. Serial: sweeps over the strand.
  const std::uint64_t run = range.shape.serial() ? range.longest : range.shape.particlesPerLane + 8;
  LoopCost cost;
  // Of a body in the way: in a lane, 17 looks at most for each particle and each edge, and as many in each of
  // eight rounds after the move; of more than four bodies no run is in the way of all. A long strand's
  // particles are not all at it at once.
  const std::uint64_t inTheWay = std::min<std::uint64_t>(bodyCount, 4);
  cost.step = 20 * run + inTheWay * run * (range.shape.serial() ? 24 : 178) + 30 * bodyCount;
  if (settings.integrator == Integrator::pointJacobi) {
    cost.solveLoops = settings.pointIterations;
    cost.perSolveLoop = run + 1;
  }
  if (settings.integrator == Integrator::paper) {
    cost.solveLoops = settings.forceLoops;
    cost.perSolveLoop = run + 1 + settings.dampingLoops * ((range.shape.serial() ? 2 : 8) * run + 1);
  }
  return cost;
}

Error tooLong(const StrandRange& range, const Settings& settings, std::uint64_t turns, std::uint64_t budget) {
  const char* remedy = !range.shape.serial() ? "ask for the serial kernel form, or fewer iterations"
                       : settings.integrator == Integrator::jacobi
                           ? "cut the strand into fewer particles, or use a GPU or the reference"
                           : "use the jacobi integrator, fewer iterations or the reference";
  return Error{fmt::format(
      "a strand of {} particles needs {} loop turns for one step of this integrator, and this device makes "
      "{} in a dispatch at most; {}",
      range.longest, turns, budget, remedy)};
}

// Cuts a frame's steps for one range into pieces within the budget: several steps a dispatch where they fit,
// else one, else (serial form only) one step in several.
Result<std::vector<PlannedDispatch>> planSteps(const StrandRange& range, const DeviceLimits& limits,
                                               const Settings& settings, std::size_t bodyCount) {
  const std::uint64_t budget = loopBudget(limits);
  const LoopCost cost = loopCost(range, settings, bodyCount);
  const std::uint64_t whole = cost.step + cost.solveLoops * cost.perSolveLoop;
  const std::uint32_t steps = static_cast<std::uint32_t>(settings.stepsPerFrame);
  const std::uint32_t loops = static_cast<std::uint32_t>(cost.solveLoops);
  std::vector<PlannedDispatch> pieces;
  if (whole <= budget) {
    const std::uint32_t stepsAtOnce = static_cast<std::uint32_t>(budget / whole);
    for (std::uint32_t s = 0; s < steps; s += stepsAtOnce) {
      pieces.push_back({.stepBegin = s,
                        .stepEnd = std::min(steps, s + stepsAtOnce),
                        .phases = layout::kPhaseAll,
                        .loopEnd = loops});
    }
    return pieces;
  }
  if (!range.shape.serial() || cost.step > budget || cost.perSolveLoop > budget) {
    return tooLong(range, settings, whole, budget);
  }
  const std::uint32_t loopsAtOnce =
      static_cast<std::uint32_t>(budget / std::max<std::uint64_t>(1, cost.perSolveLoop));
  for (std::uint32_t s = 0; s < steps; ++s) {
    pieces.push_back({.stepBegin = s, .stepEnd = s + 1, .phases = layout::kPhaseSprings});
    for (std::uint32_t l = 0; l < loops; l += loopsAtOnce) {
      pieces.push_back({.stepBegin = s,
                        .stepEnd = s + 1,
                        .phases = layout::kPhaseSolve,
                        .loopBegin = l,
                        .loopEnd = std::min(loops, l + loopsAtOnce)});
    }
    pieces.push_back({.stepBegin = s, .stepEnd = s + 1, .phases = layout::kPhaseMove});
  }
  return pieces;
}

// A lane keeps nothing from solve to solve, and computes forces anew; the serial form finds them in its
// scratch.
std::vector<PlannedDispatch> piecesOf(const StrandShape& shape, const SolvePass& pass) {
  const std::uint32_t solve = layout::kPhaseSolve | (pass.withContacts ? layout::kPhaseContacts : 0u) |
                              (pass.moves ? layout::kPhaseMove : 0u);
  if (!shape.serial()) {
    return {{.stepBegin = pass.step, .stepEnd = pass.step + (pass.goesOn ? 2 : 1), .phases = solve}};
  }
  std::vector<PlannedDispatch> pieces;
  const std::uint32_t first = layout::kPhaseSprings | layout::kPhaseSolve;
  pieces.push_back(
      {.stepBegin = pass.step, .stepEnd = pass.step + 1, .phases = pass.withContacts ? solve : first});
  if (pass.goesOn) pieces.push_back({.stepBegin = pass.step + 1, .stepEnd = pass.step + 2, .phases = first});
  return pieces;
}

// A range's pieces for as many strands at once as the device takes groups.
void spreadOverGroups(std::vector<PlannedDispatch>& plan, const StrandRange& range, std::uint32_t index,
                      const DeviceLimits& limits, std::uint32_t groupSize,
                      std::span<const PlannedDispatch> pieces) {
  const std::uint32_t strandsPerGroup = groupSize / std::max(1u, range.shape.lanes);
  const std::uint64_t strandsAtOnce = std::uint64_t{strandsPerGroup} * limits.maxGroupCount;
  for (std::uint64_t begin = range.begin; begin < range.end; begin += strandsAtOnce) {
    for (PlannedDispatch piece : pieces) {
      piece.range = index;
      piece.strandBegin = static_cast<std::uint32_t>(begin);
      piece.strandEnd = static_cast<std::uint32_t>(std::min<std::uint64_t>(range.end, begin + strandsAtOnce));
      piece.groupCount = (piece.strandEnd - piece.strandBegin + strandsPerGroup - 1) / strandsPerGroup;
      plan.push_back(piece);
    }
  }
}

}  // namespace

Result<std::vector<PlannedDispatch>> planPass(std::span<const StrandRange> ranges, const DeviceLimits& limits,
                                              const Settings& settings, std::size_t bodyCount,
                                              std::uint32_t groupSize, const SolvePass& pass) {
  std::vector<PlannedDispatch> plan;
  for (std::uint32_t r = 0; r < ranges.size(); ++r) {
    // In lanes a pass may go on to a second step; the serial form does that in a dispatch of its own.
    const std::uint64_t turns =
        (ranges[r].shape.serial() ? 1 : 2) * loopCost(ranges[r], settings, bodyCount).step;
    if (turns > loopBudget(limits)) return tooLong(ranges[r], settings, turns, loopBudget(limits));
    spreadOverGroups(plan, ranges[r], r, limits, groupSize, piecesOf(ranges[r].shape, pass));
  }
  return plan;
}

Result<std::vector<PlannedDispatch>> planFrame(std::span<const StrandRange> ranges,
                                               const DeviceLimits& limits, const Settings& settings,
                                               std::size_t bodyCount, std::uint32_t groupSize) {
  std::vector<PlannedDispatch> plan;
  for (std::uint32_t r = 0; r < ranges.size(); ++r) {
    auto steps = planSteps(ranges[r], limits, settings, bodyCount);
    if (!steps) return steps.error();
    spreadOverGroups(plan, ranges[r], r, limits, groupSize, *steps);
  }
  return plan;
}

}  // namespace ringlet
