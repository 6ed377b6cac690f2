// Implements solver/plan/dispatch_plan.h.
#include "ringlet/solver/plan/dispatch_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "layout/strands.h"

namespace ringlet {
namespace {

// Limit of loop turns of a dispatch. On devices that end loops early it is a little below the number at which
// they do. Other devices have no such limit; theirs keeps a dispatch short enough not to be taken for a hang.
std::uint64_t loopBudget(const DeviceLimits& limits) { return limits.endsLoopsEarly ? 65000 : 4'000'000; }

// Upper bounds of loop turns, for one step.
struct LoopCost {
  std::uint64_t step = 0;  // without solve loops
  std::uint64_t perSolveLoop = 0;
  std::uint64_t solveLoops = 0;
  std::uint64_t pressed = 0;  // additional turns if a whole strand is pressed onto bodies
};

// Turns of a scan over lanes, and of its squarings over the bits of the run; a single lane needs none.
std::uint64_t scanCost(const StrandShape& shape) {
  return shape.lanes == 1 ? 0 : std::countr_zero(shape.lanes) + std::bit_width(shape.particlesPerLane) + 2;
}

LoopCost loopCost(const StrandRange& range, const Settings& settings, std::size_t bodyCount) {
  // Loops over a run count in full, although drivers unroll them in registers; lavapipe counts one turn more.
  const bool inMemory = range.shape.inMemory;
  const std::uint64_t run = range.shape.particlesPerLane + (inMemory ? 1 : 8);
  LoopCost cost;
  // Sweeps over the run. In memory, those of air include 12 for the waves of turbulence, and those of bodies
  // two more solves and one round after the move.
  const std::uint64_t sweeps = inMemory ? 24 + (settings.air.on ? 14 : 0) + (bodyCount > 0 ? 20 : 0) : 20;
  // In registers a body near the run costs up to 17 evaluations per particle and per edge, and as many in
  // each of eight rounds after the move; a run is never near more than four bodies. In memory runs are long,
  // and rarely all of their particles are at the body. If they are (`pressed`), the other seven rounds take
  // 45 more sweeps, and each body takes 42 turns per particle in the solve and 24 in each round.
  const std::uint64_t inTheWay = std::min<std::uint64_t>(bodyCount, 4);
  cost.step = sweeps * run + inTheWay * run * (inMemory ? 24 : 178) + 30 * bodyCount;
  // Four scans with squarings, and up to twelve others.
  if (inMemory) cost.step += 10 * scanCost(range.shape) * (bodyCount > 0 ? 2 : 1);
  if (inMemory && bodyCount > 0) cost.pressed = run * (45 + inTheWay * (42 + 8 * 24));
  if (settings.integrator == Integrator::pointJacobi) {
    cost.solveLoops = settings.pointIterations;
    cost.perSolveLoop = run + 1;
  }
  if (settings.integrator == Integrator::paper) {
    cost.solveLoops = settings.forceLoops;
    const std::uint64_t damping =
        range.shape.lanes == 1 ? 3 * run + 1 : 4 * run + 1 + 2 * scanCost(range.shape);
    cost.perSolveLoop = run + 1 + settings.dampingLoops * damping;
  }
  return cost;
}

Error tooLong(const StrandRange& range, const Settings& settings, std::uint64_t turns, std::uint64_t budget) {
  const char* remedy = settings.integrator == Integrator::jacobi
                           ? "cut the strand into fewer particles, or use a GPU or the reference"
                       : range.shape.serial()
                           ? "use more lanes, the jacobi integrator or fewer iterations"
                           : "use the jacobi integrator, fewer iterations or the reference";
  return Error{fmt::format(
      "a strand of {} particles needs {} loop turns for one step of this integrator, and this device makes "
      "{} in a dispatch at most; {}",
      range.longest, turns, budget, remedy)};
}

// Cuts a frame's steps for one range into pieces within the budget, each of as many steps as fit.
Result<std::vector<PlannedDispatch>> planSteps(const StrandRange& range, const DeviceLimits& limits,
                                               const Settings& settings, std::size_t bodyCount,
                                               std::uint64_t mostParticleSteps) {
  const std::uint64_t budget = loopBudget(limits);
  const LoopCost cost = loopCost(range, settings, bodyCount);
  const std::uint64_t whole = cost.step + cost.solveLoops * cost.perSolveLoop;
  const std::uint32_t steps = static_cast<std::uint32_t>(settings.stepsPerFrame);
  if (whole > budget) return tooLong(range, settings, whole, budget);
  // If a single step may exceed the budget with `pressed`, each piece is one step.
  const std::uint64_t stepsThatFit = std::max<std::uint64_t>(1, budget / (whole + cost.pressed));
  const std::uint64_t particles = std::uint64_t{range.end - range.begin} * range.longest;
  const std::uint64_t bound =
      std::min(stepsThatFit, std::max<std::uint64_t>(1, mostParticleSteps / particles));
  const auto stepsAtOnce = static_cast<std::uint32_t>(std::min<std::uint64_t>(bound, steps));
  std::vector<PlannedDispatch> pieces;
  for (std::uint32_t s = 0; s < steps; s += stepsAtOnce)
    pieces.push_back({.stepBegin = s, .stepEnd = std::min(steps, s + stepsAtOnce)});
  return pieces;
}

// Cuts the pieces of a range into dispatches of as many strands as maxGroupCount and `mostParticleSteps`
// allow.
void spreadOverGroups(std::vector<PlannedDispatch>& plan, const StrandRange& range, std::uint32_t index,
                      const DispatchRoom& room, std::span<const PlannedDispatch> pieces) {
  const std::uint32_t strandsPerGroup = room.groupSize / range.shape.lanes;
  const std::uint64_t groups = room.mostParticleSteps / (std::uint64_t{strandsPerGroup} * range.longest);
  const std::uint64_t strandsAtOnce =
      strandsPerGroup * std::clamp<std::uint64_t>(groups, 1, room.limits.maxGroupCount);
  for (std::uint64_t begin = range.begin; begin < range.end; begin += strandsAtOnce) {
    for (PlannedDispatch piece : pieces) {
      piece.range = index;
      piece.strandBegin = static_cast<std::uint32_t>(begin);
      piece.strandEnd = static_cast<std::uint32_t>(std::min<std::uint64_t>(range.end, begin + strandsAtOnce));
      piece.groupCount = groupCountOf(piece, range.shape, room.groupSize);
      plan.push_back(piece);
    }
  }
}

}  // namespace

std::uint32_t clothTurns(const DeviceLimits& limits) {
  return static_cast<std::uint32_t>(loopBudget(limits) / std::max(limits.subgroupSize, 1u));
}

std::uint32_t groupCountOf(const PlannedDispatch& dispatch, const StrandShape& shape, std::uint32_t groupSize,
                           std::uint32_t heads) {
  const std::uint32_t strandsPerGroup = groupSize / shape.lanes;
  return (heads * (dispatch.strandEnd - dispatch.strandBegin) + strandsPerGroup - 1) / strandsPerGroup;
}

std::uint64_t particleStepsOf(const PlannedDispatch& dispatch, std::span<const StrandRange> ranges) {
  return std::uint64_t{dispatch.strandEnd - dispatch.strandBegin} * ranges[dispatch.range].longest *
         (dispatch.stepEnd - dispatch.stepBegin);
}

bool sharesStrands(const PlannedDispatch& a, const PlannedDispatch& b) {
  return a.range == b.range && a.strandBegin < b.strandEnd && b.strandBegin < a.strandEnd;
}

Result<std::vector<PlannedDispatch>> planPass(std::span<const StrandRange> ranges, const DispatchRoom& room,
                                              const Settings& settings, std::size_t bodyCount,
                                              const SolvePass& pass) {
  std::vector<PlannedDispatch> plan;
  for (std::uint32_t r = 0; r < ranges.size(); ++r) {
    const std::uint64_t turns = 2 * loopCost(ranges[r], settings, bodyCount).step;
    const std::uint64_t budget = loopBudget(room.limits);
    if (turns > budget) return tooLong(ranges[r], settings, turns, budget);
    // A lane keeps no state between solves and computes forces again.
    const PlannedDispatch piece{
        .stepBegin = pass.step,
        .stepEnd = pass.step + (pass.goesOn ? 2 : 1),
        .phases = (pass.withContacts ? layout::kPhaseContacts : 0u) | (pass.moves ? layout::kPhaseMove : 0u)};
    spreadOverGroups(plan, ranges[r], r, room, {&piece, 1});
  }
  return plan;
}

Result<std::vector<PlannedDispatch>> planFrame(std::span<const StrandRange> ranges, const DispatchRoom& room,
                                               const Settings& settings, std::size_t bodyCount) {
  std::vector<PlannedDispatch> plan;
  for (std::uint32_t r = 0; r < ranges.size(); ++r) {
    auto steps = planSteps(ranges[r], room.limits, settings, bodyCount, room.mostParticleSteps);
    if (!steps) return steps.error();
    spreadOverGroups(plan, ranges[r], r, room, *steps);
  }
  return plan;
}

}  // namespace ringlet
