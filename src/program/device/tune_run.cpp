// Implements tune_run.h.
#include "program/device/tune_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <map>
#include <utility>

#include "parity/tolerances.h"
#include "program/cli/interruption.h"
#include "program/cli/progress_bar.h"
#include "ringlet/solver/diagnostics.h"
#include "ringlet/solver/plan/shape_plan.h"
#include "ringlet/solver/plan/subgroup_choice.h"
#include "ringlet/solver/simulation.h"

namespace ringlet::program {
namespace {

// Largest difference after a frame, relative to a strand's length. In tests each shape is this close to the
// double reference.
double agreementAt(TuneWork work) {
  return work == TuneWork::bodies ? parity::kOneFrameAmongBodies : parity::kOneFrame;
}
constexpr int kFewestRounds = 3, kMostRounds = 101;
constexpr double kShareForMaking = 0.7;  // of the time; the rest is for timing rounds
// Particles for each length, enough to keep all lanes of the device busy: two cores have some 16 lanes, large
// GPUs 300,000.
constexpr std::uint32_t kParticlesOnCpu = 1 << 16, kParticlesOnGpu = 1 << 20;
constexpr std::uint32_t kFewerAtWork = 4;  // divisor with contacts or bodies, whose frames take longer

class Clock {
 public:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

// A shape to be timed with one kind of work and strands of one length. The first two of these are compared
// with each other.
struct Entry {
  TuneWork work = TuneWork::alone;
  std::uint32_t particleCount = 0;
  StrandShape shape;
  std::uint32_t subgroupSize = 0;
  bool isOfPair = false;
};

// For each number of lanes the shortest run that holds a strand, in the order of the cost model. Then a
// single lane in memory, if it holds a strand: for the longest strands, or if there is no other shape to
// compare with.
std::vector<Entry> entriesOf(TuneWork work, std::uint32_t particleCount, bool isLongest,
                             const DeviceLimits& limits) {
  std::vector<ShapeCost> costs = shapeCosts(limits, strandWorkOf(work));
  std::erase_if(costs, [&](const ShapeCost& c) {
    const std::uint32_t lanes = c.shape.lanes;
    if (c.shape.inMemory) return true;
    const std::uint32_t run = std::max(kShortestRun, (particleCount + lanes - 1) / lanes);
    const bool hasIdleLanes = lanes > 1 && particleCount <= (lanes / 2) * kShortestRun;
    return c.shape.particlesPerLane != run || hasIdleLanes;
  });
  std::ranges::stable_sort(costs, {}, &ShapeCost::nanoseconds);
  const bool hasSerial = particleCount <= limits.longestRunInMemory;
  if (hasSerial && (isLongest || costs.size() < 2)) costs.push_back({kAnySerialShape, 0});
  std::vector<Entry> entries;
  if (costs.size() < 2) return entries;  // no choice
  for (const ShapeCost& c : costs)
    entries.push_back({work, particleCount, c.shape, limits.subgroupSize, entries.size() < 2});
  return entries;
}

DeviceLimits atWidth(DeviceLimits limits, std::uint32_t subgroupSize) {
  limits.subgroupSize = subgroupSize;
  return limits;
}

// First the pairs that are compared, for all kinds of work, lengths and widths, in case time runs out; the
// device's default width before others. A single lane in memory needs no width.
std::vector<Entry> allEntries(const TuneOptions& options, const DeviceLimits& limits) {
  std::vector<Entry> all;
  for (const std::uint32_t width : subgroupSizes(limits)) {
    for (const TuneWork work : options.works) {
      for (const std::uint32_t length : options.lengths) {
        const bool takesSerial = length == options.lengths.back() && width == limits.subgroupSize;
        const auto some = entriesOf(work, length, takesSerial, atWidth(limits, width));
        all.insert(all.end(), some.begin(), some.end());
      }
    }
  }
  std::stable_partition(all.begin(), all.end(), std::mem_fn(&Entry::isOfPair));
  return all;
}

// A simulation with one shape, and its timings.
struct Runner {
  TimedShape result;
  Simulation simulation;
  std::size_t strandCount = 0;
  std::vector<Vec3f> positions;   // after the frame that is compared
  std::vector<double> samples{};  // [ms] of a frame

  static Result<Runner> create(const ComputeDevice& device, const Entry& entry, std::uint32_t strandCount) {
    KernelChoice choice;
    choice.form = entry.shape.serial() ? KernelChoice::Form::serial : KernelChoice::Form::lanes;
    choice.lanes = entry.shape.serial() ? 0 : static_cast<int>(entry.shape.lanes);
    choice.particlesPerLane = static_cast<int>(entry.shape.particlesPerLane);
    choice.subgroupSize = static_cast<int>(entry.subgroupSize);
    auto simulation = simulateWork(device, entry.work, entry.particleCount, strandCount, choice);
    if (!simulation) return simulation.error();
    auto positions = simulation->positions();
    if (!positions) return positions.error();
    const std::size_t made = positions->size() / entry.particleCount;
    return Runner{{.work = entry.work,
                   .particleCount = entry.particleCount,
                   .shape = entry.shape,
                   .subgroupSize = entry.subgroupSize,
                   .against = {}},
                  std::move(*simulation),
                  made,
                  std::move(*positions)};
  }

  // A position that is NaN counts as a difference.
  double differenceFrom(const Runner& other) const {
    double largest = 0;
    for (std::size_t i = 0; i < positions.size(); ++i) {
      const double apart = length(static_cast<Vec3d>(positions[i]) - static_cast<Vec3d>(other.positions[i]));
      if (!(apart <= largest)) largest = apart;
    }
    return largest / kTunedLength;
  }

  Status time() {
    const double before = Diagnostics(simulation).stageMilliseconds()["strand_step"];
    if (Status stepped = stepWork(result.work, simulation); !stepped) return stepped;
    samples.push_back(Diagnostics(simulation).stageMilliseconds()["strand_step"] - before);
    return {};
  }

  // The result of the samples so far. A clock too coarse for a frame would give 0, which is no valid cost.
  TimedShape finished(const DeviceLimits& limits) const {
    TimedShape timed = result;
    const auto model = shapeCosts(atWidth(limits, timed.subgroupSize), strandWorkOf(timed.work));
    timed.model = std::ranges::find(model, timed.shape, &ShapeCost::shape)->nanoseconds /
                  (timed.shape.serial() ? 1 : timed.particleCount);
    if (samples.empty()) return timed;
    std::vector<double> sorted = samples;
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
    std::ranges::nth_element(sorted, middle);
    const double particleSteps =
        static_cast<double>(strandCount) * timed.particleCount * Settings{}.stepsPerFrame;
    timed.nanoseconds = std::max(1e6 * *middle / particleSteps, 1e-6);
    return timed;
  }
};

// The start of a message: the kind of work.
std::string workBefore(TuneWork work) {
  return work == TuneWork::alone ? "" : fmt::format("{}: ", nameOf(work));
}

ShapeTrouble troubleOf(const Entry& entry, const Error& cause) {
  return {entry.work, entry.particleCount, entry.shape, entry.subgroupSize,
          Error{fmt::format("{}strands of {} particles in the shape {}: {}", workBefore(entry.work),
                            entry.particleCount, entry.shape.describe(), cause.message),
                cause.fault}};
}

// Compares the last runner with the first of its kind of work and length.
Status verifyLast(std::vector<Runner>& runners) {
  Runner& last = runners.back();
  Runner& first = *std::ranges::find_if(runners, [&](const Runner& runner) {
    return runner.result.work == last.result.work && runner.result.particleCount == last.result.particleCount;
  });
  if (&first == &last) return {};
  const double difference = last.differenceFrom(first);
  last.result.difference = difference;
  last.result.against = first.result.shape;
  if (first.result.difference == 0)
    first.result.difference = difference, first.result.against = last.result.shape;
  const double allowed = agreementAt(last.result.work);
  if (difference <= allowed) return {};
  return Error{fmt::format(
      "{}strands of {} particles in the shapes {} and {} are {:.1e} of their length apart after a frame, "
      "{:.0e} is allowed: one of the two is wrong on this device; `--backend reference` tells which",
      workBefore(last.result.work), last.result.particleCount, first.result.shape.describe(),
      last.result.shape.describe(), difference, allowed)};
}

// Costs for hair alone. If a shape was timed with several lengths, the mean counts.
std::vector<ShapeCost> costsOf(std::span<const TimedShape> timed, std::uint32_t subgroupSize) {
  std::vector<ShapeCost> costs;
  std::vector<int> counts;
  for (const TimedShape& one : timed) {
    if (one.work != TuneWork::alone) continue;
    if (one.subgroupSize != subgroupSize && !one.shape.serial()) continue;
    const double cost = one.nanoseconds * (one.shape.serial() ? 1 : one.particleCount);
    const auto found = std::ranges::find(costs, one.shape, &ShapeCost::shape);
    if (found == costs.end()) {
      costs.push_back({one.shape, cost}), counts.push_back(1);
    } else {
      found->nanoseconds += cost, ++counts[static_cast<std::size_t>(found - costs.begin())];
    }
  }
  for (std::size_t i = 0; i < costs.size(); ++i) costs[i].nanoseconds /= counts[i];
  return costs;
}

Result<Runner> runnerFor(const ComputeDevice& device, const Entry& entry, const TuneOptions& options) {
  const auto filling = (device.limits().isCpu ? kParticlesOnCpu : kParticlesOnGpu) / entry.particleCount /
                       (entry.work == TuneWork::alone ? 1 : kFewerAtWork);
  const auto strandCount = options.strandCount ? static_cast<std::uint32_t>(*options.strandCount) : filling;
  const EndsUnheard compiling;
  return Runner::create(device, entry, std::max(strandCount, 1u));
}

// What the runners measured, and what follows from it.
void conclude(const std::vector<Runner>& runners, const DeviceLimits& limits, TuneOutcome& outcome) {
  std::vector<WidthTime> times;
  for (const Runner& runner : runners) {
    const TimedShape one = runner.finished(limits);
    outcome.timed.push_back(one);
    if (one.work == TuneWork::alone) times.push_back({one.particleCount, one.subgroupSize, one.nanoseconds});
  }
  std::ranges::stable_sort(outcome.timed, {}, [](const TimedShape& one) {
    return std::pair{one.work, one.particleCount};
  });
  if (outcome.interrupted || times.empty()) return;
  outcome.subgroupSize = fastestSubgroupSize(times);
  const bool isTroubled =
      std::ranges::find(outcome.troubles, TuneWork::alone, &ShapeTrouble::work) != outcome.troubles.end();
  if (!isTroubled) outcome.costs = costsOf(outcome.timed, outcome.subgroupSize);
}

}  // namespace

std::vector<std::uint32_t> typicalLengths(std::vector<std::uint32_t> counts) {
  std::ranges::sort(counts);
  std::vector<std::uint32_t> lengths;
  for (std::size_t quarter = 1; quarter <= 4 && !counts.empty(); ++quarter)
    lengths.push_back(counts[(counts.size() * quarter + 3) / 4 - 1]);
  lengths.erase(std::unique(lengths.begin(), lengths.end()), lengths.end());
  return lengths;
}

Result<TuneOutcome> timeShapes(const ComputeDevice& device, const TuneOptions& options) {
  const Clock clock;
  const DeviceLimits limits = device.limits();
  const std::vector<Entry> entries = allEntries(options, limits);
  if (entries.empty())
    return Error{
        fmt::format("{} has only one lane in memory for strands of {} particles; there is nothing to choose",
                    device.name(), options.lengths.back())};
  TuneOutcome outcome;
  ProgressBar progress(0, static_cast<int>(std::ceil(options.seconds)), options.showProgress, "second");
  const auto isTimeFor = [&](double share) {
    progress.show(static_cast<int>(std::min(clock.seconds(), std::ceil(options.seconds))));
    return clock.seconds() < share * options.seconds;
  };
  catchInterruption();
  std::vector<Runner> runners;
  // Reports the results so far, but not more often than once a second.
  double grown = -1;
  const auto grow = [&]() -> Status {
    if (!options.grow || clock.seconds() < grown + 1) return {};
    grown = clock.seconds();
    TuneOutcome soFar = outcome;
    for (const Runner& runner : runners) soFar.timed.push_back(runner.finished(limits));
    return options.grow(soFar);
  };

  for (std::size_t e = 0; e < entries.size() && !wasInterrupted(); ++e) {
    const Entry& entry = entries[e];
    const bool endsPair = entry.isOfPair && e % 2 == 1;
    if (!isTimeFor(kShareForMaking) && e > 0 && !endsPair) {
      outcome.leftOut = entries.size() - e;
      break;
    }
    auto runner = runnerFor(device, entry, options);
    if (!runner) {
      outcome.troubles.push_back(troubleOf(entry, runner.error()));
      if (runner.error().fault == Fault::deviceLost) return outcome.troubles.back().error;
    } else {
      runners.push_back(std::move(*runner));
      if (Status verified = verifyLast(runners); !verified)
        outcome.troubles.push_back(
            {entry.work, entry.particleCount, entry.shape, entry.subgroupSize, verified.error()});
    }
    if (Status grew = grow(); !grew) return grew.error();
  }
  if (runners.empty() && !outcome.troubles.empty()) return outcome.troubles.front().error;

  while (!wasInterrupted() && outcome.rounds < kMostRounds &&
         (isTimeFor(1) || outcome.rounds < kFewestRounds)) {
    for (Runner& runner : runners) {
      if (Status timed = runner.time(); !timed) return timed.error();
    }
    ++outcome.rounds;
    if (Status grew = grow(); !grew) return grew.error();
  }
  outcome.interrupted = wasInterrupted();
  conclude(runners, limits, outcome);
  return outcome;
}

}  // namespace ringlet::program
