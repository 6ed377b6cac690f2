// The contacts of a step, stage by stage, for 10,000, 100,000 and 1,000,000 contact particles: first that the
// lists hold the pairs that are near, then how long each part takes. Every timed step makes its lists anew,
// and half of the hair is pressed into itself, so that it touches. Prints, in one run, milliseconds a step
// (device time) of building the grid, of the query, and of the forces, beside the strands' own, and process
// CPU time per core. Run: build/release/bench/contacts_bench
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "bench/clocks.h"
#include "bench/device_main.h"
#include "ringlet/base/box_pairs.h"
#include "ringlet/solver/diagnostics.h"
#include "ringlet/solver/simulation.h"

namespace {

using namespace ringlet;
using bench::median;
using bench::processCpuSeconds;

constexpr int kParticles = 16;      // of a strand
constexpr double kRadius = 0.003;   // [m]
constexpr double kSpacing = 0.005;  // along a strand, so that all are contact particles [m]
constexpr double kNear = 6;         // particles within 2 radii and the skin of one, in the mean
constexpr double kSkin = kContactMargin * 2 * kRadius;

const ComputeDevice* device = nullptr;

// Straight strands anywhere and in any direction in a cube, as densely as kNear says [m].
Groom tangle(int contacts) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  const double side = (2 * kRadius + kSkin) * std::cbrt(4.19 * contacts / kNear);
  std::uniform_real_distribution<double> place(-side / 2, side / 2);
  Groom groom;
  groom.metresPerUnit = 1;
  for (int s = 0; s < contacts / kParticles; ++s) {
    const Vec3d root{place(random), place(random), place(random)};
    const Vec3d any{normal(random), normal(random), normal(random)}, direction = any / length(any);
    std::vector<Vec3f> points;
    for (int i = 0; i < kParticles; ++i) points.push_back(Vec3f(root + direction * (kSpacing * i)));
    groom.addStrand(points);
  }
  return groom;
}

// The half beyond x = 0 is pressed by a twentieth: everything that overlaps there touches.
std::vector<Vec3f> pressed(const Groom& groom) {
  std::vector<Vec3f> points = groom.points;
  for (Vec3f& p : points) {
    if (p.x > 0) p = p * 0.95f;
  }
  return points;
}

// A step so short that what is near is so by place alone.
Settings tangleSettings() {
  Settings settings;
  settings.stepsPerFrame = 1;
  settings.framesPerSecond = 1e6;
  settings.contacts.on = true;
  settings.contacts.method = ContactMethod::explicitPairs;
  settings.contacts.radius = kRadius;
  settings.contacts.prunePairs = false;
  return settings;
}

// Pairs of different strands, not both roots, nearer than where they touch and the skin; and the seconds that
// takes on one thread, with base/box_pairs.h. Those within rounding of the edge are counted apart.
struct Near {
  std::uint64_t pairs = 0, onEdge = 0;
  double seconds = 0;
};
Near nearPairs(const std::vector<Vec3f>& rest, const std::vector<Vec3f>& points);

Near nearPairs(const std::vector<Vec3f>& rest, const std::vector<Vec3f>& points) {
  const double R = 2 * kRadius, start = processCpuSeconds();
  std::vector<Box> boxes;
  for (const Vec3f& p : points)
    boxes.push_back({static_cast<Vec3d>(p), Vec3d{1, 1, 1} * ((kContactTaperEnd * R + kSkin) / 2)});
  const BoxPairs grid(boxes);
  Near near;
  for (std::size_t i = 0; i < points.size(); ++i) {
    grid.visitPartners(i, [&](std::size_t j) {
      if (i / kParticles == j / kParticles || (i % kParticles == 0 && j % kParticles == 0)) return;
      const double apart = length(static_cast<Vec3d>(points[i]) - static_cast<Vec3d>(points[j]));
      const double restApart = length(static_cast<Vec3d>(rest[i]) - static_cast<Vec3d>(rest[j]));
      const double reach = kContactTaperEnd * std::min(R, restApart - 1e-4 * R) + kSkin;
      if (std::abs(apart - reach) < 2e-5 * R)
        ++near.onEdge;
      else if (apart < reach)
        ++near.pairs;
    });
  }
  near.seconds = processCpuSeconds() - start;
  return near;
}

void contacts(benchmark::State& state) {
  const int count = static_cast<int>(state.range(0));
  const Groom groom = tangle(count);
  auto simulation = Simulation::create(*device, groom, {}, tangleSettings());
  if (!simulation) return state.SkipWithError(simulation.error().message.c_str());
  const HairState hair{pressed(groom), std::vector<Vec3f>(groom.points.size())};

  // The lists: made once, which also lets the driver compile and the lists grow.
  if (Status status = simulation->setState(hair); !status)
    return state.SkipWithError(status.error().message.c_str());
  if (Status status = simulation->stepFrame(HeadPose{}); !status)
    return state.SkipWithError(status.error().message.c_str());
  const auto report = simulation->contactReport();
  if (!report) return state.SkipWithError(report.error().message.c_str());
  const Near near = nearPairs(groom.points, hair.positions);
  if (report->listed < near.pairs || report->listed > near.pairs + near.onEdge)
    return state.SkipWithError("the lists do not hold the pairs that are near; not timed");

  std::map<std::string, std::vector<double>> samples;  // [ms]
  for (auto _ : state) {
    if (!simulation->setState(hair)) return state.SkipWithError("a state was refused");
    auto before = Diagnostics(*simulation).stageMilliseconds();
    const double cpu = processCpuSeconds();
    if (!simulation->stepFrame(HeadPose{})) return state.SkipWithError("a step failed");
    samples["cpu_per_core"].push_back(1e3 * (processCpuSeconds() - cpu) / coreCount());
    for (const auto& [stage, milliseconds] : Diagnostics(*simulation).stageMilliseconds())
      samples[stage].push_back(milliseconds - before[stage]);
  }
  double step = 0;
  for (const auto& [stage, values] : samples) {
    if (stage == kCopyStage || stage == "cpu_per_core") continue;
    step += median(values);
  }
  const double build = median(samples["contact_grid"]), query = median(samples["contact_query"]);
  const double force = median(samples["contact_motion"]) + median(samples["contact_touch"]) +
                       median(samples["contact_system"]);
  state.counters["build_ms"] = build;
  state.counters["query_ms"] = query;
  state.counters["force_ms"] = force;
  state.counters["strand_ms"] = median(samples["strand_step"]);
  state.counters["share_of_step"] = (build + query + force) / step;
  state.counters["cpu_ms_per_core"] = median(samples["cpu_per_core"]);
  state.counters["cpp_grid_ms"] = 1e3 * near.seconds;
  state.counters["listed"] = static_cast<double>(report->listed);
  state.counters["contacts"] = static_cast<double>(report->contacts);
}

}  // namespace

int main(int argc, char** argv) {
  return bench::runOnDevice(argc, argv, "contacts_bench", device, [] {
    fmt::print(
        "A step whose lists are made anew; cpp_grid_ms: finding the same pairs on one thread, with\n"
        "base/box_pairs.h. 'contacts' touch or did; 'listed' are near.\n");
    benchmark::RegisterBenchmark("contacts", contacts)
        ->Arg(10'000)
        ->Arg(100'000)
        ->Arg(1'000'000)
        ->Unit(benchmark::kMillisecond)
        ->Iterations(11);
  });
}
