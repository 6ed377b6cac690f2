// Implements solver/shape_plan.h.
#include "ringlet/solver/shape_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace ringlet {
namespace {

// The model: a lane costs its particles, real or not, and for each doubling of lanes a join; [ns] of a step.
struct WorkModel {
  double particle;  // in one of several lanes
  double ofTwo;     // in one of two
  double alone;     // in a strand's only lane, which has nothing to do twice
  double join;      // of a lane, for each doubling of lanes
  double longRun;   // how much dearer a particle is for each one a run has above four
  double serial;    // a particle of the serial form
};
struct CostModel {
  WorkModel hairAlone, plain, bodies;
  double perKernel, perRun;  // a kernel more, and each particle of its run, on every step: see below
};

// Of the CPU device fitted to what `ringlet tune` measures on lavapipe 22.3 (two quiet cores, 16 to 128
// particles), within a fifth of each; bodies to a head with a sphere in it. It does everything for all lanes,
// and a long run is nothing to it; but among bodies, where every particle is picked from its run, runs of 8
// are as fast as longer ones and half as long in the making. Of GPUs not measured, but reasoned: a particle
// of a run is some 50 registers, so that long runs leave fewer strands at a time to wait with; a join is a
// few shuffles; the serial form goes through memory.
//
// A kernel is prepared at every start: on lavapipe 30 ms for each particle of its run and 50 ms besides,
// three times that the first time. Over 10,000 steps, 50 s of animation, that is 3 and 5 microseconds a step:
// a few hundred strands get a kernel that is there soon, more one that is fast; and of kernels for one length
// each only as many as pay. GPUs' drivers are no quicker, but their steps are.
constexpr CostModel kCpu{
    .hairAlone = {.particle = 10.5, .ofTwo = 8.2, .alone = 7.3, .join = 4, .longRun = 0, .serial = 53},
    .plain = {.particle = 10.5, .ofTwo = 10.5, .alone = 8, .join = 4, .longRun = 0, .serial = 53},
    .bodies = {.particle = 60, .ofTwo = 60, .alone = 60, .join = 20, .longRun = 0.02, .serial = 260},
    .perKernel = 5'000,
    .perRun = 3'000};
constexpr CostModel kGpu{
    .hairAlone = {.particle = 0.5, .ofTwo = 0.35, .alone = 0.35, .join = 0.25, .longRun = 0.125, .serial = 5},
    .plain = {.particle = 0.5, .ofTwo = 0.5, .alone = 0.5, .join = 0.25, .longRun = 0.125, .serial = 5},
    .bodies = {.particle = 3, .ofTwo = 3, .alone = 3, .join = 0.5, .longRun = 0.125, .serial = 25},
    .perKernel = 5'000,
    .perRun = 3'000};

// Longer runs are faster still on a CPU device, but a kernel of 64 particles a lane takes lavapipe 5 s to
// make for the first time: only where they are asked for, or were measured.
constexpr std::uint32_t kLongestUnaskedRun = 32;

constexpr double kLastResort = 1e9;  // [ns] of a particle, in place of a cost

const CostModel& modelOf(const DeviceLimits& limits) { return limits.isCpu ? kCpu : kGpu; }

double modelCost(const StrandShape& shape, const CostModel& model, StrandWork work) {
  const WorkModel& of = work == StrandWork::hairAlone ? model.hairAlone
                        : work == StrandWork::bodies  ? model.bodies
                                                      : model.plain;
  if (shape.serial()) return of.serial;
  const double particle = (shape.lanes == 1   ? of.alone
                           : shape.lanes == 2 ? of.ofTwo
                                              : of.particle) *
                          (1 + of.longRun * (shape.particlesPerLane - kShortestRun));
  return shape.lanes * (shape.particlesPerLane * particle + std::countr_zero(shape.lanes) * of.join);
}

// Of a kernel, on every step. The serial form's is as long in the making as a run of 8.
double preparingCost(const StrandShape& shape, const CostModel& model) {
  return model.perKernel + model.perRun * (shape.serial() ? 8 : shape.particlesPerLane);
}

// What may be chosen from: as asked for, by rising capacity; the serial form, where allowed, last.
std::vector<ShapeCost> candidates(const DeviceLimits& limits, const KernelChoice& choice, StrandWork work) {
  const auto measured = work == StrandWork::hairAlone ? choice.measured : std::span<const ShapeCost>{};
  std::vector<ShapeCost> costs = shapeCosts(limits, work, measured);
  const bool isStated = choice.lanes > 0 || choice.particlesPerLane > 0;
  const bool isAskedFor = isStated || choice.form == KernelChoice::Form::lanes;
  std::erase_if(costs, [&](const ShapeCost& c) {
    if (c.shape.serial()) return choice.form == KernelChoice::Form::lanes;
    const bool isMeasured = std::ranges::find(measured, c.shape, &ShapeCost::shape) != measured.end();
    if (c.shape.particlesPerLane > kLongestUnaskedRun && !isAskedFor && !isMeasured) return true;
    return choice.form == KernelChoice::Form::serial ||
           (choice.lanes > 0 && c.shape.lanes != static_cast<std::uint32_t>(choice.lanes)) ||
           (choice.particlesPerLane > 0 &&
            c.shape.particlesPerLane != static_cast<std::uint32_t>(choice.particlesPerLane));
  });
  // Where lanes or runs are stated, serial is only what does not fit them.
  if (isStated && !costs.empty() && costs.back().shape.serial()) costs.back().nanoseconds = kLastResort;
  return costs;
}

// Of the ways to cut the strands at the candidates' capacities the cheapest, from the shortest strands on.
// best[j]: up to candidate j's capacity, which is the last in use.
struct Cut {
  double cost = std::numeric_limits<double>::infinity();
  std::size_t end = 0;         // strands it covers
  std::ptrdiff_t before = -1;  // the candidate in use for shorter strands
};

// Of so many strands of so many particles in one shape, on every step. A subgroup is as slow with idle lanes.
double rangeCost(const ShapeCost& cost, std::size_t strands, std::uint64_t particles,
                 const DeviceLimits& limits) {
  const std::size_t each = limits.subgroupSize / std::max(1u, cost.shape.lanes);
  const auto filled = static_cast<double>((strands + each - 1) / each * each);
  if (!cost.shape.serial()) return filled * cost.nanoseconds;
  const double share = cost.nanoseconds == kLastResort ? 1 : filled / static_cast<double>(strands);
  return share * static_cast<double>(particles) * cost.nanoseconds;
}

std::vector<StrandRange> cheapestRanges(std::span<const std::uint32_t> counts,
                                        std::span<const ShapeCost> costs, const DeviceLimits& limits,
                                        bool manyKernels) {
  std::vector<std::uint64_t> particlesBefore{0};
  for (std::uint32_t count : counts) particlesBefore.push_back(particlesBefore.back() + count);
  std::vector<Cut> best(costs.size());
  for (std::size_t j = 0; j < costs.size(); ++j) {
    const StrandShape& shape = costs[j].shape;
    best[j].end =
        shape.serial()
            ? counts.size()
            : static_cast<std::size_t>(std::ranges::upper_bound(counts, shape.capacity()) - counts.begin());
    for (std::ptrdiff_t i = -1; i < static_cast<std::ptrdiff_t>(j); ++i) {
      const Cut from = i < 0 ? Cut{.cost = 0} : best[static_cast<std::size_t>(i)];
      if (from.end >= best[j].end) continue;
      const double kernel = manyKernels ? 0 : preparingCost(shape, modelOf(limits));
      const double cost = from.cost + kernel +
                          rangeCost(costs[j], best[j].end - from.end,
                                    particlesBefore[best[j].end] - particlesBefore[from.end], limits);
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

// What the device does not have at all, by name.
Status checkChoice(const DeviceLimits& limits, const KernelChoice& choice, StrandWork work) {
  const int run = choice.particlesPerLane;
  const int longest = static_cast<int>(longestRun(limits, choice.lanes, work));
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

Error doesNotFit(std::uint32_t particleCount, const DeviceLimits& limits, const KernelChoice& choice,
                 StrandWork work) {
  const std::uint32_t lanes =
      choice.lanes > 0 ? static_cast<std::uint32_t>(choice.lanes) : limits.subgroupSize;
  const int run = choice.particlesPerLane > 0 ? choice.particlesPerLane
                                              : static_cast<int>(longestRun(limits, lanes, work));
  return Error{fmt::format(
      "the lanes form was asked for, but a strand of {} particles does not fit: {}. Leave the choice to "
      "ringlet "
      "or ask for the serial form",
      particleCount,
      limits.hasSubgroupShuffle
          ? fmt::format("{} lanes of {} hold {}", lanes, run, lanes * static_cast<std::uint32_t>(run))
          : "this device has no subgroup shuffles")};
}

}  // namespace

std::string StrandShape::describe() const {
  return serial() ? "serial" : fmt::format("lanes {} x {}", lanes, particlesPerLane);
}

StrandWork strandWork(const Settings& settings, const Material& material, bool hasBodies) {
  if (hasBodies) return StrandWork::bodies;
  const bool isAlone = settings.integrator == Integrator::jacobi && !settings.contacts.on &&
                       !settings.air.on && material.bendStiffnessProfile.points.empty();
  return isAlone ? StrandWork::hairAlone : StrandWork::plain;
}

// 24, so that 128 particles are 8 runs of 16 and not half as many of 32, which are dearer to make; but what
// few lanes save is worth it, and beyond the most lanes there is only the serial form, 4 times slower.
std::uint32_t longestRun(const DeviceLimits& limits, std::uint32_t lanes, StrandWork work) {
  if (!limits.isCpu) return 16;
  const bool isFew = work == StrandWork::hairAlone && lanes <= 2;
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
  costs.push_back({});
  double ratios = 0;
  int known = 0;
  for (ShapeCost& c : costs) {
    c.nanoseconds = modelCost(c.shape, model, work);
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
  const bool isHeld = !costs.empty() &&
                      (costs.back().shape.serial() || particleCounts.back() <= costs.back().shape.capacity());
  if (!isHeld) return doesNotFit(particleCounts.back(), limits, choice, work);
  return cheapestRanges(particleCounts, costs, limits, choice.manyKernels);
}

}  // namespace ringlet
