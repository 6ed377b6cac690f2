// The strand kernel beside its baselines, and beside what the processor can do: first that they agree with
// the double reference, then how long each takes, in turn, medians. Run: build/release/bench/kernels_bench
//
// * device_ms, wall_ms, cpu_ms: an outer step of all strands; device time, of the frame, CPU time of all
// cores.
// * Mparticles/s, GFLOP/s, GB/s: by device time; operations as operation_count.h counts them; bytes that a
//   dispatch must move.
// * of_peak: share of what AVX2 multiply-adds on all cores do, measured in the same rounds.
// * reference_ms, reference_float_ms: one thread. over_reference: times faster than the double one.
// * hand_ms, hand_alone_ms: the hand-vectorised loop, all cores and one thread. over_hand: device_ms over
// hand_ms.
// * over_reference_by_cpu, over_hand_by_cpu: by CPU time, for busy machines whose device is the CPU.
// * lanes: 0 as chosen; 1 or 2 with runs as long as `ringlet tune` tries, which nobody gets unasked.
// * over_uniform: mixed lengths only; time a particle over that of 64 particles a strand, as many particles
// in all.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <cmath>

#include "bench/clocks.h"
#include "bench/curls.h"
#include "bench/device_main.h"
#include "bench/peaks.h"
#include "bench/strand_contest.h"

namespace {

using namespace ringlet;
using namespace ringlet::bench;

const ComputeDevice* device = nullptr;

int roundsFor(int particles) { return std::clamp(4'000'000 / particles, 7, 31); }

void report(benchmark::State& state, const Contest& contest, double overUniform) {
  const ContestSamples& s = contest.samples();
  const double seconds = median(s.kernel);
  state.counters["device_ms"] = 1e3 * seconds;
  state.counters["wall_ms"] = 1e3 * median(s.kernelWall);
  state.counters["cpu_ms"] = 1e3 * median(s.kernelCpu);
  state.counters["Mparticles/s"] = 1e-6 * contest.particles() / seconds;
  state.counters["GFLOP/s"] = 1e-9 * contest.operationsPerStep() / seconds;
  state.counters["GB/s"] = 1e-9 * contest.bytesPerStep() / seconds;
  state.counters["of_peak"] = medianRatio(s.peak, s.kernel);
  state.counters["reference_ms"] = 1e3 * median(s.referenceDouble);
  state.counters["reference_float_ms"] = 1e3 * median(s.referenceFloat);
  state.counters["over_reference"] = medianRatio(s.referenceDouble, s.kernel);
  state.counters["hand_ms"] = 1e3 * median(s.hand);
  state.counters["hand_alone_ms"] = 1e3 * median(s.handAlone);
  state.counters["over_hand"] = medianRatio(s.kernel, s.hand);
  state.counters["over_reference_by_cpu"] = coreCount() * medianRatio(s.referenceCpu, s.kernelCpu);
  state.counters["over_hand_by_cpu"] = medianRatio(s.kernelCpu, s.handCpu);
  state.counters["over_uniform"] = overUniform;
  state.SetLabel(contest.kernel());
}

void strandStep(benchmark::State& state) {
  const int particles = static_cast<int>(state.range(0)), strands = static_cast<int>(state.range(1));
  auto contest = Contest::create(*device, std::vector<int>(static_cast<std::size_t>(strands), particles),
                                 static_cast<int>(state.range(2)), Baselines::all,
                                 {.lanes = static_cast<int>(state.range(3))});
  if (!contest) return state.SkipWithError(contest.error().message.c_str());
  for (auto _ : state) {
    if (Status status = contest->round(); !status) return state.SkipWithError(status.error().message.c_str());
  }
  report(state, *contest, std::nan(""));
}

void mixedStep(benchmark::State& state) {
  const int steps = static_cast<int>(state.range(0));
  const std::vector<int> mixed = mixedCounts(2048);
  auto contest = Contest::create(*device, mixed, steps, Baselines::all,
                                 {.lanes = static_cast<int>(state.range(1))}),
       uniform = Contest::create(*device, uniformCounts(mixed, 64), steps, Baselines::none);
  if (!contest) return state.SkipWithError(contest.error().message.c_str());
  if (!uniform) return state.SkipWithError(uniform.error().message.c_str());
  for (auto _ : state) {
    for (Contest* each : {&*contest, &*uniform}) {
      if (Status status = each->round(); !status) return state.SkipWithError(status.error().message.c_str());
    }
  }
  const double particlesRatio = uniform->particles() / contest->particles();
  report(state, *contest, particlesRatio * medianRatio(contest->samples().kernel, uniform->samples().kernel));
}

void registerStep(int particles, int strands, int lanes) {
  for (const int steps : {4, 8}) {
    benchmark::RegisterBenchmark("strand_step", strandStep)
        ->ArgNames({"particles", "strands", "steps", "lanes"})
        ->Args({particles, strands, steps, lanes})
        ->Unit(benchmark::kMillisecond)
        ->Iterations(roundsFor(particles * strands));
  }
}

void registerAll() {
  for (const int particles : {16, 32, 64, 128, 256}) {
    for (const int strands : {512, 2048, 8192, 32768}) registerStep(particles, strands, 0);
  }
  const bool hasLongRuns = device->limits().isCpu;
  if (hasLongRuns) registerStep(64, 2048, 1), registerStep(128, 2048, 2);
  for (const int lanes : hasLongRuns ? std::vector{0, 2} : std::vector{0}) {
    for (const int steps : {4, 8}) {
      benchmark::RegisterBenchmark("mixed_16_to_128", mixedStep)
          ->ArgNames({"steps", "lanes"})
          ->Args({steps, lanes})
          ->Unit(benchmark::kMillisecond)
          ->Iterations(21);
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  return runOnDevice(argc, argv, "kernels_bench", device, [] {
    ThreadTeam team(coreCount());
    fmt::print(
        "{} cores: {:.1f} GFLOP/s of multiply-adds, {:.1f} GB/s of copying\nhand-vectorised loop: {}\n",
        coreCount(), 1e-9 * multiplyAddPeak(team, 0.2), 1e-9 * CopyPeak().measure(team), sweepFlags());
    registerAll();
  });
}
