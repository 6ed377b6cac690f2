// Cost beside quality: what a frame of 1,000 hanging curls of 64 particles at 60 Hz costs by every
// integrator, and how far it is from right. Each is verified against the double reference of the same scheme
// before it is timed; one that disagrees is not timed. Run: build/release/bench/quality_bench
//
// droop: of the tip after 10 s without preload [mm]; of one curl, which moves as each of the thousand does.
// transient: largest distance of the tip over the first 0.5 s from the exact solve (jacobi) in double at 32
// steps a 60 Hz frame, share of that one's droop. Times are medians over frames.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "bench/clocks.h"
#include "reference/step.h"
#include "ringlet/scenes/builtin_scene.h"
#include "ringlet/solver/diagnostics.h"
#include "ringlet/solver/simulation.h"

namespace {

using namespace ringlet;
using bench::median;
using bench::processCpuSeconds;
using bench::wallSeconds;

constexpr int kStrands = 1000, kParticles = 64;
constexpr double kFramesPerSecond = 60;
constexpr double kSettleSeconds = 10, kTransientSeconds = 0.5;
constexpr int kTimedFrames = 31;
constexpr int kTruthSteps = 32;  // a frame

// One frame against double, share of the strand's length: tests/support/tolerances.h, kOneFrame.
constexpr double kAgreement = 1e-5;

// One row of the table.
struct Contender {
  std::string name;
  Integrator integrator = Integrator::jacobi;
  int steps = 4;             // a frame
  int iterations = 100;      // of point_jacobi
  double bendStiffness = 0;  // instead of the preset's [w]; 0: the preset's
};

BuiltinScene sceneOf(const Contender& contender, int strands, double seconds) {
  auto scene = makeScene("hanging_curl", {.particles = kParticles,
                                          .strands = strands,
                                          .preload = 0,
                                          .stepsPerFrame = contender.steps,
                                          .seconds = seconds,
                                          .integrator = contender.integrator});
  scene->settings.framesPerSecond = kFramesPerSecond;
  scene->frameCount = static_cast<int>(std::max(1L, std::lround(seconds * kFramesPerSecond)));
  scene->settings.pointIterations = contender.iterations;
  if (contender.bendStiffness > 0) scene->material.bendStiffness = contender.bendStiffness;
  return std::move(*scene);
}

using Path = std::vector<Vec3d>;

// The tip of the last strand, the start first.
Path tipPath(reference::Simulation<double> simulation, const BuiltinScene& scene) {
  const auto tip = [&] {
    const auto& p = simulation.positions().back();
    return Vec3d{p.x(), p.y(), p.z()};
  };
  const std::vector<HeadPose> still(static_cast<std::size_t>(scene.settings.stepsPerFrame));
  Path path{tip()};
  for (int frame = 0; frame < scene.frameCount; ++frame) {
    simulation.stepFrame(still);
    path.push_back(tip());
  }
  return path;
}
Path truePath(const BuiltinScene& scene) {
  return tipPath(reference::Simulation<double>(scene.groom, scene.material, scene.settings), scene);
}
Result<Path> devicePath(const ComputeDevice& device, const BuiltinScene& scene) {
  auto simulation = Simulation::create(device, scene.groom, scene.material, scene.settings);
  if (!simulation) return simulation.error();
  Path path;
  for (int frame = 0; frame <= scene.frameCount; ++frame) {
    if (frame > 0) {
      if (Status stepped = simulation->stepFrame(HeadPose{}); !stepped) return stepped.error();
    }
    const auto positions = simulation->positions();
    if (!positions) return positions.error();
    path.push_back(Vec3d(positions->back()));
  }
  return path;
}

double largestDistance(const Path& a, const Path& b) {
  double largest = 0;
  for (std::size_t k = 0; k < std::min(a.size(), b.size()); ++k) {
    const double distance = length(a[k] - b[k]);
    if (!std::isfinite(distance)) return INFINITY;
    largest = std::max(largest, distance);
  }
  return largest;
}

struct Cost {
  double device = 0, wall = 0, cpu = 0;  // a frame [ms]
};

Result<Cost> timeFrames(const ComputeDevice& device, const BuiltinScene& scene) {
  auto simulation = Simulation::create(device, scene.groom, scene.material, scene.settings);
  if (!simulation) return simulation.error();
  std::vector<double> deviceSamples, wallSamples, cpuSamples;
  for (int frame = -2; frame < kTimedFrames; ++frame) {  // drivers compile at the first dispatch
    const double before = Diagnostics(*simulation).stageMilliseconds()["strand_step"];
    const double wall = wallSeconds(), cpu = processCpuSeconds();
    if (Status stepped = simulation->stepFrame(HeadPose{}); !stepped) return stepped.error();
    if (frame < 0) continue;
    wallSamples.push_back(1e3 * (wallSeconds() - wall));
    cpuSamples.push_back(1e3 * (processCpuSeconds() - cpu));
    deviceSamples.push_back(Diagnostics(*simulation).stageMilliseconds()["strand_step"] - before);
  }
  return Cost{median(deviceSamples), median(wallSamples), median(cpuSamples)};
}

// A row, or why there is none.
std::string rowOf(const ComputeDevice& device, const Contender& contender) {
  // Right, as its own scheme goes?
  const BuiltinScene frame = sceneOf(contender, 1, 1 / kFramesPerSecond);
  const auto found = devicePath(device, frame);
  if (!found) return found.error().message;
  const double disagreement = largestDistance(*found, truePath(frame)) / 0.25;
  if (!(disagreement < kAgreement))
    return fmt::format("differs from double by {:.1e} of its length; not timed", disagreement);

  // How far from the exact solve of small steps.
  Contender exact = contender;
  exact.integrator = Integrator::jacobi;
  exact.steps = kTruthSteps;
  const Path truth = truePath(sceneOf(exact, 1, kTransientSeconds));
  const Path settledTruth = truePath(sceneOf(exact, 1, 3));
  const auto path = devicePath(device, sceneOf(contender, 1, kTransientSeconds));
  const auto settled = devicePath(device, sceneOf(contender, 1, kSettleSeconds));
  if (!path) return path.error().message;
  if (!settled) return settled.error().message;
  const double droop = settled->front().y - settled->back().y;
  const double trueDroop = settledTruth.front().y - settledTruth.back().y;
  const double transient = largestDistance(*path, truth) / trueDroop;

  // And what it costs.
  const auto cost = timeFrames(device, sceneOf(contender, kStrands, 1));
  if (!cost) return cost.error().message;
  return fmt::format("{:>10.2f} {:>10.2f} {:>10.2f} {:>12.2f} {:>12.2f}", cost->device, cost->wall, cost->cpu,
                     1e3 * droop, 1e2 * transient);
}

// The bend stiffness at which the curl droops 2 mm, to three digits; of bigger ones only the core would help.
double stiffnessForTwoMillimetres() {
  Contender contender;
  contender.steps = 8;
  double low = 5, high = 500;
  for (int k = 0; k < 12; ++k) {
    contender.bendStiffness = std::sqrt(low * high);
    const Path path = truePath(sceneOf(contender, 1, 3));
    (path.front().y - path.back().y > 0.002 ? low : high) = contender.bendStiffness;
  }
  return std::sqrt(low * high);
}

}  // namespace

int main() {
  const auto device = ComputeDevice::open();
  if (!device) {
    fmt::print(stderr, "quality_bench: {}\n", device.error().message);
    return 1;
  }
  const double stiff = stiffnessForTwoMillimetres();
  const std::string stiffName = fmt::format("jacobi, K_b {:.0f} w", stiff);
  const std::vector<Contender> contenders = {
      {"jacobi", Integrator::jacobi, 2},
      {"jacobi", Integrator::jacobi, 4},
      {"jacobi", Integrator::jacobi, 8},
      {stiffName, Integrator::jacobi, 4, 100, stiff},
      {"point_jacobi, 25", Integrator::pointJacobi, 4, 25},
      {"point_jacobi, 100", Integrator::pointJacobi, 4, 100},
      {"point_jacobi, 400", Integrator::pointJacobi, 4, 400},
      {"paper", Integrator::paper, 12},
  };
  fmt::print("device: {} ({}); {} curls of {} particles, {} frames a second\n", device->name(),
             device->driver(), kStrands, kParticles, kFramesPerSecond);
  fmt::print("{:<22}{:>6} {:>10} {:>10} {:>10} {:>12} {:>12}\n", "integrator", "steps", "device ms",
             "wall ms", "CPU ms", "droop mm", "transient %");
  for (const Contender& contender : contenders) {
    fmt::print("{:<22}{:>6} {}\n", contender.name, contender.steps, rowOf(*device, contender));
    std::fflush(stdout);
  }
  return 0;
}
