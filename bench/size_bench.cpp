// What a groom larger than a device's buffers takes: memory, start and frames of a million curls of 16
// particles, verified before it is told: every so many strands, simulated without the others, have the same
// bits. Run: build/release/bench/size_bench [STRANDS [PARTICLES]]
#include <fmt/format.h>
#include <sys/resource.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "bench/clocks.h"
#include "ringlet/groom/generate.h"
#include "ringlet/solver/diagnostics.h"
#include "ringlet/solver/plan/shape_plan.h"
#include "ringlet/solver/simulation.h"

namespace {

using namespace ringlet;

constexpr int kFrames = 4;
constexpr std::size_t kSampled = 1000;  // strands

double peakHostMebibytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}
double mebibytes(std::uint64_t bytes) { return static_cast<double>(bytes) / (1 << 20); }

HeadPose headAt(int frame) {
  return {Vec3d{0.01 * frame, 0, 0}, fromRotationVector(Vec3d{0, 0.05 * frame, 0})};
}

// What the first frame took, in which drivers compile, and each of the others [s]; or why not.
struct FrameSeconds {
  double first = 0, other = 0;
};
Result<FrameSeconds> step(Simulation& simulation) {
  const double start = bench::wallSeconds();
  FrameSeconds seconds;
  for (int frame = 1; frame <= kFrames; ++frame) {
    if (Status status = simulation.stepFrame(headAt(frame)); !status) return status.error();
    if (frame == 1) seconds.first = bench::wallSeconds() - start;
  }
  seconds.other = (bench::wallSeconds() - start - seconds.first) / (kFrames - 1);
  return seconds;
}

// The lanes and run that strands, all of one length, are planned to have: fewer strands might have others,
// and other bits.
Result<KernelChoice> kernelOf(const ComputeDevice& device, const Groom& groom) {
  const std::vector<std::uint32_t> counts(groom.strandCount(), groom.firstPoint[1] - groom.firstPoint[0]);
  const auto ranges = planRanges(counts, device.limits(), {});
  if (!ranges) return ranges.error();
  const StrandShape& shape = ranges->front().shape;
  KernelChoice kernel;
  if (shape.inMemory) kernel.form = KernelChoice::Form::memory;
  kernel.lanes = static_cast<int>(shape.lanes);
  kernel.particlesPerLane = static_cast<int>(shape.particlesPerLane);
  return kernel;
}

// Particles of the sampled strands that are elsewhere when those are simulated without the others.
Result<std::size_t> countOthers(const ComputeDevice& device, const Groom& groom, std::size_t stride,
                                const std::vector<Vec3f>& positions) {
  Groom sample;
  sample.metresPerUnit = groom.metresPerUnit;
  for (std::size_t s = 0; s < groom.strandCount(); s += stride) sample.addStrand(groom.strand(s));
  const auto kernel = kernelOf(device, groom);
  if (!kernel) return kernel.error();
  auto simulation = Simulation::create(device, sample, {}, {}, {}, *kernel);
  if (!simulation) return simulation.error();
  if (auto stepped = step(*simulation); !stepped) return stepped.error();
  const auto alone = simulation->positions();
  if (!alone) return alone.error();
  std::size_t others = 0, at = 0;
  for (std::size_t s = 0; s < groom.strandCount(); s += stride) {
    for (std::uint32_t i = groom.firstPoint[s]; i < groom.firstPoint[s + 1]; ++i)
      if (!(positions[i] == (*alone)[at++])) ++others;
  }
  return others;
}

Status run(int strands, int particles) {
  auto device = ComputeDevice::open();
  if (!device) return device.error();
  SwatchParameters parameters;
  parameters.columnCount = 1000;
  parameters.rowCount = std::max(1, strands / 1000);
  parameters.curl.particleCount = particles;
  parameters.curl.turns = 3;
  parameters.variation = {.radius = 0.3, .length = 0.3, .phase = 1};
  const auto groom = makeSwatch(parameters);
  if (!groom) return groom.error();
  const double hostBefore = peakHostMebibytes();

  double start = bench::wallSeconds();
  auto simulation = Simulation::create(*device, *groom, {}, {});
  if (!simulation) return simulation.error();
  const double created = bench::wallSeconds() - start;
  const double hostCreated = peakHostMebibytes();
  const auto frame = step(*simulation);
  if (!frame) return frame.error();
  start = bench::wallSeconds();
  const auto positions = simulation->positions();
  if (!positions) return positions.error();
  const double read = bench::wallSeconds() - start;
  const auto report = simulation->report();
  if (!report) return report.error();

  const std::size_t stride = std::max<std::size_t>(1, groom->strandCount() / kSampled);
  const auto others = countOthers(*device, *groom, stride, *positions);
  if (!others) return others.error();
  if (*others > 0 || report->nonfinite > 0)
    return Error{fmt::format("{} particles are not where their strands are alone, {} are nowhere", *others,
                             report->nonfinite)};

  const DeviceMemory memory = Diagnostics(*simulation).memory();
  fmt::print("{} strands, {} particles, {} on {}\n", groom->strandCount(), groom->points.size(),
             Diagnostics(*simulation).kernels(), device->name());
  fmt::print("  every {}th strand is, bit for bit, where it is alone\n", stride);
  fmt::print("  device   {:.0f} MiB: particles {:.0f}, strands {:.0f}, frames in flight {:.0f}\n",
             mebibytes(memory.total()), mebibytes(memory.particles), mebibytes(memory.strands),
             mebibytes(memory.frames));
  fmt::print("  host     {:.0f} MiB with the groom, {:.0f} at most while starting, {:.0f} at most in all\n",
             hostBefore, hostCreated, peakHostMebibytes());
  fmt::print("  start    {:.1f} s\n  frame    {:.0f} ms (8 steps; the first {:.0f})\n  readback {:.0f} ms\n",
             created, 1000 * frame->other, 1000 * frame->first, 1000 * read);
  return {};
}

}  // namespace

int main(int count, char** arguments) {
  const int strands = count > 1 ? std::atoi(arguments[1]) : 1'000'000;
  const int particles = count > 2 ? std::atoi(arguments[2]) : 16;
  const Status status = run(strands, particles);
  if (status) return 0;
  fmt::print(stderr, "size_bench: {}\n", status.error().message);
  return 1;
}
