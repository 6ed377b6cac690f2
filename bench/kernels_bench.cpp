// The strand kernel against the double reference on one thread: first that they agree, then how long each
// takes. Prints, in one run, milliseconds per outer step (device time, wall time, process CPU time per core)
// and their ratio. Run: build/release/bench/kernels_bench
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <map>
#include <numbers>
#include <thread>

#include "reference/step.h"
#include "ringlet/solver/simulation.h"

namespace {

using namespace ringlet;

constexpr int kStrands = 2048;

// Curls of 1 cm radius, 8 turns (at least 4 particles a turn) and 25 cm, side by side [m].
Groom curls(int strands, int particles) {
  Groom groom;
  groom.metresPerUnit = 1;
  const double turns = std::min(8.0, particles / 4.0);
  for (int s = 0; s < strands; ++s) {
    std::vector<Vec3f> points;
    for (int i = 0; i < particles; ++i) {
      const double u = double(i) / (particles - 1), angle = 2 * std::numbers::pi * turns * u;
      points.push_back({static_cast<float>(0.01 * std::cos(angle) + 0.001 * (s % 64)),
                        static_cast<float>(-0.25 * u),
                        static_cast<float>(0.01 * std::sin(angle) + 0.001 * (s / 64))});
    }
    groom.addStrand(points);
  }
  return groom;
}

// Seconds on a thread of its own, as the CPU counted them, for the reference; whole process for the device.
double processCpuSeconds() {
  timespec t;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

Settings settingsOf(int steps) {
  Settings settings;
  settings.stepsPerFrame = steps;
  return settings;
}

const ComputeDevice* device = nullptr;
std::map<int, double> referenceMilliseconds;  // per step, by particles

// The device's positions after a shaken frame against double, as a share of the strand's length; the
// benchmark's licence.
double disagreement(int particles, int steps) {
  const Groom groom = curls(64, particles);
  const Settings settings = settingsOf(steps);
  auto simulation = Simulation::create(*device, groom, {}, settings);
  if (!simulation) return INFINITY;
  reference::Simulation<double> expected(groom, {}, settings);
  std::vector<HeadPose> poses;
  for (int k = 1; k <= steps; ++k)
    poses.push_back({{0.5 * std::pow(k * settings.stepSeconds(), 2), 0, 0}, {}});
  if (!simulation->stepFrame(poses)) return INFINITY;
  expected.stepFrame(poses);
  const auto found = *simulation->positions();
  double largest = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    largest = std::max(largest, (reference::toEigen<double>(found[i]) - expected.positions()[i]).norm());
  }
  return largest / 0.25;
}

void referenceStep(benchmark::State& state) {
  const int particles = static_cast<int>(state.range(0));
  reference::Simulation<double> simulation(curls(kStrands, particles), {}, settingsOf(8));
  const std::vector<HeadPose> pose(1);
  std::vector<double> samples;
  for (auto _ : state) {
    const double start = processCpuSeconds();
    simulation.stepFrame(pose);
    samples.push_back(processCpuSeconds() - start);
  }
  std::nth_element(samples.begin(), samples.begin() + static_cast<std::ptrdiff_t>(samples.size() / 2),
                   samples.end());
  referenceMilliseconds[particles] = 1e3 * samples[samples.size() / 2];
  state.counters["ms_per_step"] = referenceMilliseconds[particles];
}

void strandStep(benchmark::State& state) {
  const int particles = static_cast<int>(state.range(0)), steps = static_cast<int>(state.range(1));
  const double difference = disagreement(particles, steps);
  if (!(difference < 1e-5)) return state.SkipWithError("the kernel disagrees with the reference; not timed");
  auto simulation = Simulation::create(*device, curls(kStrands, particles), {}, settingsOf(steps));
  if (!simulation) return state.SkipWithError(simulation.error().message.c_str());
  const std::vector<HeadPose> poses(static_cast<std::size_t>(steps));
  (void)simulation->stepFrame(poses);  // drivers compile at the first dispatch
  std::vector<double> deviceSamples, cpuSamples;
  for (auto _ : state) {
    const double before = simulation->stageMilliseconds()["strand_step"], cpu = processCpuSeconds();
    if (!simulation->stepFrame(poses)) return state.SkipWithError("a frame failed");
    deviceSamples.push_back(simulation->stageMilliseconds()["strand_step"] - before);
    cpuSamples.push_back(processCpuSeconds() - cpu);
  }
  const auto median = [](std::vector<double>& v) {
    std::nth_element(v.begin(), v.begin() + static_cast<std::ptrdiff_t>(v.size() / 2), v.end());
    return v[v.size() / 2];
  };
  const double perStep = median(deviceSamples) / steps;
  state.counters["ms_per_step"] = perStep;
  state.counters["cpu_ms_per_core"] =
      1e3 * median(cpuSamples) / steps / std::max(1u, std::thread::hardware_concurrency());
  state.counters["Mparticles/s"] = 1e-3 * kStrands * particles / perStep;
  state.counters["over_reference"] = referenceMilliseconds[particles] / perStep;
  state.SetLabel(simulation->kernelDescription());
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  auto opened = ComputeDevice::open();
  if (!opened) {
    fmt::print(stderr, "kernels_bench: {}\n", opened.error().message);
    return 1;
  }
  device = &*opened;
  fmt::print(
      "device: {} ({}), {} strands; over_reference: times faster than the double reference on one thread\n",
      device->name(), device->driver(), kStrands);
  for (int particles : {32, 64, 128}) {
    benchmark::RegisterBenchmark("reference_step", referenceStep)
        ->Arg(particles)
        ->Unit(benchmark::kMillisecond)
        ->Iterations(9);
    for (int steps : {4, 8}) {
      benchmark::RegisterBenchmark("strand_step", strandStep)
          ->Args({particles, steps})
          ->Unit(benchmark::kMillisecond)
          ->Iterations(31);
    }
  }
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
