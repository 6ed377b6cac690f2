// Implements solver/plan/shape_plan.h.
#include "ringlet/solver/plan/shape_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "ringlet/base/assert.h"

namespace ringlet {
namespace {

// Model of the time that a strand of a shape takes for a step [ns]: the particles of each lane, idle ones
// included, and the join of the lanes (shaders/scan/star_join.glsl). Up to four lanes, or four groups of
// lanes, are joined in rounds, one fewer than there are; a group of lanes is joined by doublings.
struct WorkModel {
  double particle;   // a particle, with three or more lanes
  double ofTwo;      // a particle, with two lanes
  double alone;      // a particle, with a single lane, which computes nothing twice
  double round;      // a round of the join
  double doubling;   // a doubling of the join
  double longRun;    // relative extra cost of a particle, for each particle of the run above four
  double longerRun;  // extra longRun per doubling, whose registers the run lacks
  double inMemory;   // a particle, with a single lane and its run in memory
};
struct CostModel {
  WorkModel hairAlone, plain, bodies;
  double perKernel, perRun;  // a kernel, and each particle of its run, spread over steps: see below
};

// CPU devices: fitted to what `ringlet tune` measures on lavapipe 22.3 (two quiet cores, 16 to 128
// particles), within a fifth of each value. A long run has no extra cost there. With bodies fitted to a head
// on a mesh, 16 to 128 particles, within a tenth. With bodies a join is slow: lavapipe runs the code for body
// contacts once whether or not a lane has any, and the fewer strands a subgroup has, the more often.
//
// GPUs: not measured. Fitted to what RADV 25 compiles for navi21 in subgroups of 32
// (scripts/count_instructions.sh), within a fifth for hair alone up to runs of 8. One vector instruction of
// one lane counts as 1.25e-3 ns, as on an integrated GPU; only ratios matter, also to the time a kernel takes
// to prepare. A spilled dword counts as 15 instructions: at 1.5 TB/s, assumed for the last cache of a large
// GPU, it takes the time of 30, and half of that is assumed to be hidden by the work of other subgroups. If
// it costs more than 9, runs of 4 are best for 32 particles and more: runs of 8 take a quarter to a third
// fewer instructions, but spill 160 to 450 dwords a lane and step. Runs of 16 spill 600 to 2,600; the model
// underestimates them, but only strands that no shorter run can hold get them.
//
// A kernel is prepared at every start: on lavapipe 30 ms for each particle of its run and 50 ms in addition,
// three times as long the first time. Over 10,000 steps, 50 s of animation, that is 3 and 5 microseconds a
// step: for a few hundred strands a kernel that is ready soon is best, for more strands one that is fast.
// RADV takes some 0.1 s for each particle of a run the first time, and then reads its cache; a third of the
// first time is counted, which gives the same numbers. Intel's driver takes up to ten times as long the first
// time.
//
// In the order of WorkModel: particle, ofTwo, alone, round, doubling, longRun, longerRun, inMemory.
constexpr CostModel kCpu{.hairAlone = {10.5, 8.2, 7.3, 2.7, 4, 0, 0, 45},
                         .plain = {10.5, 10.5, 8, 2.7, 4, 0, 0, 45},
                         .bodies = {37.5, 58, 63, 75, 0, 0, 0, 140},
                         .perKernel = 5'000,
                         .perRun = 3'000};
constexpr CostModel kGpu{.hairAlone = {0.5, 0.38, 0.36, 0.26, 0.62, 0.15, 0.12, 6.5},
                         .plain = {0.57, 0.57, 0.43, 0.3, 0.7, 0.2, 0.12, 6.5},
                         .bodies = {3.6, 3.6, 2.5, 0.3, 0.7, 0.08, 0.12, 25},
                         .perKernel = 5'000,
                         .perRun = 3'000};

// On a CPU device longer runs are even faster, but lavapipe compiles a kernel of 64 particles per lane in 5
// s. They are used only if they are asked for or were measured.
constexpr std::uint32_t kLongestUnaskedRun = 32;

constexpr double kLastResort = 1e6;  // factor that makes a shape costlier than any other

const CostModel& modelOf(const DeviceLimits& limits) { return limits.isCpu ? kCpu : kGpu; }

bool isFromEnds(StrandWork work) { return work == StrandWork::hairAlone || work == StrandWork::volume; }

double modelCost(const StrandShape& shape, const CostModel& model, StrandWork work) {
  const WorkModel& of = isFromEnds(work)             ? model.hairAlone
                        : work == StrandWork::bodies ? model.bodies
                                                     : model.plain;
  const int doublings = std::max(0, std::countr_zero(shape.lanes) - 2);  // until four groups are left
  const std::uint32_t rounds = std::min(shape.lanes, 4u) - 1;
  const double longRun = of.longRun + doublings * of.longerRun;
  const double inRegisters = shape.lanes == 1 ? of.alone : shape.lanes == 2 ? of.ofTwo : of.particle;
  // In memory, several lanes cost more than one by the same factor as in registers.
  const double particle = shape.inMemory
                              ? of.inMemory * (inRegisters / of.alone)
                              : inRegisters * (1 + longRun * (shape.particlesPerLane - kShortestRun));
  return shape.lanes * (shape.particlesPerLane * particle + rounds * of.round + doublings * of.doubling);
}

// Cost of preparing a kernel, per step. lavapipe clears a run in memory particle by particle, and compiling
// that takes as long as compiling any other code.
double preparingCost(const StrandShape& shape, const CostModel& model) {
  return model.perKernel + model.perRun * shape.particlesPerLane;
}

bool isAskedFor(int asked, std::uint32_t value) {
  return asked <= 0 || value == static_cast<std::uint32_t>(asked);
}

std::vector<ShapeCost> registerCandidates(const DeviceLimits& limits, const KernelChoice& choice,
                                          StrandWork work) {
  const auto measured = work == StrandWork::hairAlone ? choice.measured : std::span<const ShapeCost>{};
  std::vector<ShapeCost> costs = shapeCosts(limits, work, measured);
  costs.pop_back();  // kAnySerialShape
  const bool mayBeLong =
      choice.lanes > 0 || choice.particlesPerLane > 0 || choice.form == KernelChoice::Form::lanes;
  std::erase_if(costs, [&](const ShapeCost& c) {
    const bool isMeasured = std::ranges::find(measured, c.shape, &ShapeCost::shape) != measured.end();
    if (c.shape.particlesPerLane > kLongestUnaskedRun && !mayBeLong && !isMeasured) return true;
    return !isAskedFor(choice.lanes, c.shape.lanes) ||
           !isAskedFor(choice.particlesPerLane, c.shape.particlesPerLane);
  });
  return costs;
}

// Run lengths in memory: enough of them that few particles of a run are idle, and no more kernels than
// necessary.
std::vector<std::uint32_t> runsInMemory(const DeviceLimits& limits, const KernelChoice& choice) {
  if (choice.particlesPerLane > 0) return {static_cast<std::uint32_t>(choice.particlesPerLane)};
  std::vector<std::uint32_t> runs;
  for (std::uint32_t run = 8; run <= limits.longestRunInMemory; run += run < 128 ? 8 : 32)
    runs.push_back(run);
  return runs;
}

bool hasMeasuredSerial(const KernelChoice& choice, StrandWork work) {
  return choice.form == KernelChoice::Form::automatic && work == StrandWork::hairAlone &&
         std::ranges::find(choice.measured, kAnySerialShape, &ShapeCost::shape) != choice.measured.end();
}

// Whether shapes in memory may have this number of lanes. By default it is that of a subgroup: runs are then
// short and compile quickly. A single lane is a little faster, but a GPU's private memory cannot hold its
// run.
bool isOffered(std::uint32_t lanes, const DeviceLimits& limits, const KernelChoice& choice) {
  if (lanes > 1 && !limits.hasSubgroupShuffle) return false;
  if (choice.form == KernelChoice::Form::serial) return lanes == 1;
  if (choice.form == KernelChoice::Form::memory && choice.lanes > 0) return isAskedFor(choice.lanes, lanes);
  return lanes == (limits.hasSubgroupShuffle ? limits.subgroupSize : 1);
}

std::vector<ShapeCost> memoryCandidates(const DeviceLimits& limits, const KernelChoice& choice,
                                        StrandWork work) {
  const auto measured = work == StrandWork::hairAlone ? choice.measured : std::span<const ShapeCost>{};
  const double unit =
      shapeCosts(limits, work, measured).back().nanoseconds /
      modelCost({1, 1, true}, modelOf(limits), work);  // ratio of measured cost to the model's
  std::vector<ShapeCost> costs;
  for (std::uint32_t lanes = 1; lanes <= limits.subgroupSize; lanes *= 2) {
    if (!isOffered(lanes, limits, choice) && !(lanes == 1 && hasMeasuredSerial(choice, work))) continue;
    for (const std::uint32_t run : runsInMemory(limits, choice)) {
      const StrandShape shape{lanes, run, true};
      costs.push_back({shape, unit * modelCost(shape, modelOf(limits), work)});
    }
  }
  return costs;
}

// The shapes that the choice allows, by rising capacity.
std::vector<ShapeCost> candidates(const DeviceLimits& limits, const KernelChoice& choice, StrandWork work) {
  using Form = KernelChoice::Form;
  std::vector<ShapeCost> costs;
  if (choice.form == Form::automatic || choice.form == Form::lanes)
    costs = registerCandidates(limits, choice, work);
  if (choice.form == Form::lanes) return costs;
  KernelChoice others = choice;
  if (choice.form == Form::automatic) others.lanes = others.particlesPerLane = 0;
  const std::uint32_t held = costs.empty() ? 0 : costs.back().shape.capacity();
  const bool isStated = choice.form == Form::automatic && (choice.lanes > 0 || choice.particlesPerLane > 0);
  for (ShapeCost c : memoryCandidates(limits, others, work)) {
    if (c.shape.capacity() <= held && !(c.shape.serial() && hasMeasuredSerial(choice, work))) continue;
    if (isStated) c.nanoseconds *= kLastResort;  // only for strands that fit nothing else
    costs.push_back(c);
  }
  std::ranges::stable_sort(costs, {}, [](const ShapeCost& c) { return c.shape.capacity(); });
  return costs;
}

// The cheapest way to cut the strands at the capacities of candidates, by dynamic programming from the
// shortest strands on. best[j]: for strands up to the capacity of candidate j, which is the last one used.
struct Cut {
  double cost = std::numeric_limits<double>::infinity();
  std::size_t end = 0;         // number of strands covered
  std::ptrdiff_t before = -1;  // the candidate used for the next shorter strands
};

// Cost of this number of strands in one shape, per step. Idle lanes of a subgroup cost as much as busy ones.
double rangeCost(const ShapeCost& cost, std::size_t strands, const DeviceLimits& limits) {
  const std::size_t each = limits.subgroupSize / cost.shape.lanes;
  RINGLET_ASSERT(each > 0, "more lanes than a subgroup has");
  const std::size_t withIdle = (strands + each - 1) / each * each;
  return static_cast<double>(withIdle) * cost.nanoseconds;
}

std::vector<StrandRange> cheapestRanges(std::span<const std::uint32_t> counts,
                                        std::span<const ShapeCost> costs, const DeviceLimits& limits,
                                        const KernelChoice& choice) {
  std::vector<Cut> best(costs.size());
  for (std::size_t j = 0; j < costs.size(); ++j) {
    const StrandShape& shape = costs[j].shape;
    best[j].end =
        static_cast<std::size_t>(std::ranges::upper_bound(counts, shape.capacity()) - counts.begin());
    for (std::ptrdiff_t i = -1; i < static_cast<std::ptrdiff_t>(j); ++i) {
      const Cut from = i < 0 ? Cut{.cost = 0} : best[static_cast<std::size_t>(i)];
      if (from.end >= best[j].end) continue;
      const double kernel =
          choice.manyKernels ? 0 : preparingCost(shape, modelOf(limits)) / std::max(1, choice.heads);
      const double cost = from.cost + kernel + rangeCost(costs[j], best[j].end - from.end, limits);
      if (cost < best[j].cost) best[j].cost = cost, best[j].before = i;
    }
  }

  std::ptrdiff_t last = -1;
  for (std::size_t j = 0; j < best.size(); ++j) {
    if (best[j].end == counts.size() &&
        (last < 0 || best[j].cost < best[static_cast<std::size_t>(last)].cost))
      last = static_cast<std::ptrdiff_t>(j);
  }
  std::vector<StrandRange> ranges;
  for (; last >= 0; last = best[static_cast<std::size_t>(last)].before) {
    const Cut& cut = best[static_cast<std::size_t>(last)];
    const std::size_t begin = cut.before < 0 ? 0 : best[static_cast<std::size_t>(cut.before)].end;
    ranges.push_back({costs[static_cast<std::size_t>(last)].shape, static_cast<std::uint32_t>(begin),
                      static_cast<std::uint32_t>(cut.end), counts[cut.end - 1]});
  }
  std::ranges::reverse(ranges);
  return ranges;
}

// Fails if the device does not have what the choice asks for.
Status checkChoice(const DeviceLimits& limits, const KernelChoice& choice, StrandWork work) {
  const int run = choice.particlesPerLane;
  const bool isInMemory =
      choice.form == KernelChoice::Form::memory || choice.form == KernelChoice::Form::serial;
  const int longest =
      static_cast<int>(isInMemory ? limits.longestRunInMemory : longestRun(limits, choice.lanes, work));
  if (run != 0 && (run < static_cast<int>(kShortestRun) || run > longest))
    return Error{fmt::format("{} particles per lane was asked for; {} to {} are possible, 0 chooses", run,
                             kShortestRun, longest)};
  const auto lanes = static_cast<std::uint32_t>(std::max(choice.lanes, 0));
  if (choice.lanes != 0 && (!std::has_single_bit(lanes) || lanes > limits.subgroupSize)) {
    std::string possible;
    for (std::uint32_t l = 1; l <= limits.subgroupSize; l *= 2)
      possible += fmt::format("{}{}", l == 1 ? "" : 2 * l > limits.subgroupSize ? " or " : ", ", l);
    return Error{fmt::format("{} lanes a strand were asked for; this device can have {}, 0 chooses",
                             choice.lanes, possible)};
  }
  return {};
}

// The error for a strand longer than the capacity of the widest shape.
Error isTooLong(std::uint32_t particleCount, const StrandShape& widest) {
  return Error{fmt::format(
      "a strand of {} particles does not fit this device: {} {} of {} in memory hold {}; cut the strand into "
      "fewer particles, or use the reference",
      particleCount, widest.lanes, widest.lanes == 1 ? "lane" : "lanes", widest.particlesPerLane,
      widest.capacity())};
}

Error doesNotFit(std::uint32_t particleCount, const DeviceLimits& limits, const KernelChoice& choice,
                 StrandWork work) {
  const std::uint32_t lanes =
      choice.lanes > 0 ? static_cast<std::uint32_t>(choice.lanes) : limits.subgroupSize;
  const int run = choice.particlesPerLane > 0 ? choice.particlesPerLane
                                              : static_cast<int>(longestRun(limits, lanes, work));
  return Error{fmt::format(
      "the lanes form was asked for, but a strand of {} particles does not fit: {}. Leave the choice to "
      "ringlet or ask for runs in memory",
      particleCount,
      limits.hasSubgroupShuffle
          ? fmt::format("{} lanes of {} hold {}", lanes, run, lanes * static_cast<std::uint32_t>(run))
          : "this device has no subgroup shuffles")};
}

}  // namespace

std::string StrandShape::describe() const {
  if (*this == kAnySerialShape) return "serial";
  const char* form = serial() ? "serial" : inMemory ? "memory" : "lanes";
  return fmt::format("{} {} x {}", form, lanes, particlesPerLane);
}

StrandWork strandWork(const Settings& settings, const Material& material, ContactKinds kinds,
                      bool hasBodies) {
  if (hasBodies) return StrandWork::bodies;
  const bool isFromEnds = settings.integrator == Integrator::jacobi && !kinds.pairs && !settings.air.on &&
                          material.bendStiffnessProfile.points.empty() && !material.hasEdgeProfiles();
  if (!isFromEnds) return StrandWork::plain;
  return kinds.volume ? StrandWork::volume : StrandWork::hairAlone;
}

// 24, so that 128 particles are 8 runs of 16 and not half as many of 32, which take longer to compile. One or
// two lanes save enough to be worth long runs; and strands beyond the capacity of the widest shape would have
// runs in memory, 4 times slower.
std::uint32_t longestRun(const DeviceLimits& limits, std::uint32_t lanes, StrandWork work) {
  if (!limits.isCpu) return 16;
  const bool isFew = isFromEnds(work) && lanes <= 2;
  const bool isWidest = work != StrandWork::bodies && (lanes == 0 || lanes == limits.subgroupSize);
  return isFew || isWidest ? kLongestRun : 24;
}

std::vector<ShapeCost> shapeCosts(const DeviceLimits& limits, StrandWork work,
                                  std::span<const ShapeCost> measured) {
  const CostModel& model = modelOf(limits);
  std::vector<ShapeCost> costs;
  for (std::uint32_t lanes = 1; limits.hasSubgroupShuffle && lanes <= limits.subgroupSize; lanes *= 2) {
    for (std::uint32_t run = kShortestRun; run <= longestRun(limits, lanes, work); ++run)
      costs.push_back({{lanes, run}, 0});
  }
  std::ranges::stable_sort(costs, {}, [](const ShapeCost& c) { return c.shape.capacity(); });
  costs.push_back({kAnySerialShape, 0});
  double ratios = 0;
  int known = 0;
  for (ShapeCost& c : costs) {
    const bool isAnySerial = c.shape == kAnySerialShape;
    c.nanoseconds = modelCost(isAnySerial ? StrandShape{1, 1, true} : c.shape, model, work);
    const auto found = std::ranges::find(measured, c.shape, &ShapeCost::shape);
    if (found != measured.end()) ratios += std::log(found->nanoseconds / c.nanoseconds), ++known;
  }
  for (ShapeCost& c : costs) {
    const auto found = std::ranges::find(measured, c.shape, &ShapeCost::shape);
    c.nanoseconds = found != measured.end() ? found->nanoseconds
                    : known > 0             ? c.nanoseconds * std::exp(ratios / known)
                                            : c.nanoseconds;
  }
  return costs;
}

Result<std::vector<StrandRange>> planRanges(std::span<const std::uint32_t> particleCounts,
                                            const DeviceLimits& limits, const KernelChoice& choice,
                                            StrandWork work) {
  if (Status possible = checkChoice(limits, choice, work); !possible) return possible.error();
  const std::vector<ShapeCost> costs = candidates(limits, choice, work);
  if (costs.empty() || particleCounts.back() > costs.back().shape.capacity()) {
    if (costs.empty() || choice.form == KernelChoice::Form::lanes)
      return doesNotFit(particleCounts.back(), limits, choice, work);
    return isTooLong(particleCounts.back(), costs.back().shape);
  }
  return cheapestRanges(particleCounts, costs, limits, choice);
}

std::vector<StrandRange> rangesOfPart(std::span<const StrandRange> whole,
                                      std::span<const std::uint32_t> particleCounts) {
  std::vector<StrandRange> ranges;
  std::uint32_t begin = 0;
  for (const StrandRange& range : whole) {
    const auto end = static_cast<std::uint32_t>(std::ranges::upper_bound(particleCounts, range.longest) -
                                                particleCounts.begin());
    if (end > begin) ranges.push_back({range.shape, begin, end, particleCounts[end - 1]});
    begin = end;
  }
  return ranges;
}

}  // namespace ringlet
