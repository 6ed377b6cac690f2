// Whole frames of the Simulation class: hair alone, with contacts (as they are chosen, and all pair by pair),
// with bodies. First that a frame of a small groom of the same kind is what the reference says, then medians
// of a frame of 8 steps in which the head turns. Run: build/release/bench/step_bench
//
// * device_ms: all stages of stepping on the device; of them strand_ms, and contact_ms all that contacts add.
// * copy_ms: of positions to the host, on the device too.
// * wall_ms: stepFrame and positions() together; readback_ms: positions() alone.
// * cpu_ms: of the process, all cores together.
//
// Contacts and bodies are for grooms up to 10,000 strands: 100,000 with either would take minutes on a CPU.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <cmath>
#include <map>

#include "bench/clocks.h"
#include "bench/device_main.h"
#include "reference/step.h"
#include "ringlet/bodies/shape_grid.h"
#include "ringlet/groom/generate.h"
#include "ringlet/solver/diagnostics.h"
#include "ringlet/solver/simulation.h"

namespace {

using namespace ringlet;
using namespace ringlet::bench;

constexpr int kFrames = 9, kMostVerifiedStrands = 64;
constexpr double kStrandLength = 0.25;  // [m]
// One frame, share of a strand's length: tests/support/tolerances.h, kOneFrame and kOneFrameAmongBodies.
constexpr double kAgreement = 1e-5, kAgreementAmongBodies = 1e-4;

const ComputeDevice* device = nullptr;

enum class Kind { hair, contacts, explicitContacts, bodies };
bool hasContacts(Kind kind) { return kind == Kind::contacts || kind == Kind::explicitContacts; }

Groom headOf(int strands, int particles) {
  HeadParameters head;
  head.strandCount = strands;
  head.curl.particleCount = particles;
  head.curl.turns = std::min(8.0, particles / 4.0);
  head.curl.length = kStrandLength;
  return *makeHead(head);
}

Settings settingsOf(Kind kind) {
  Settings settings;
  settings.contacts.on = hasContacts(kind);
  if (kind == Kind::explicitContacts) settings.contacts.method = ContactMethod::explicitPairs;
  return settings;
}

// The head as a sphere, and shoulders as a distance grid.
std::vector<Body> bodiesOf(Kind kind) {
  if (kind != Kind::bodies) return {};
  const Bounds bounds{{-0.3, -0.33, -0.12}, {0.3, -0.07, 0.12}};
  const auto shoulders = [](Vec3d p) {  // a capsule along X
    const Vec3d fromLine{p.x - std::clamp(p.x, -0.2, 0.2), p.y + 0.2, p.z};
    return length(fromLine) - 0.08;
  };
  Body head{.name = "head", .radius = 0.088};
  Body grid{.name = "shoulders", .shape = BodyShape::grid};
  grid.grid = std::make_shared<const DistanceGrid>(sampleDistance(shoulders, bounds, 0.01));
  return {head, grid};
}

// Turning by 1.5 degrees a frame.
HeadPose poseAfter(int frames) {
  const double half = 0.5 * 0.026 * frames;
  return {{}, {0, std::sin(half), 0, std::cos(half)}};
}
std::vector<HeadPose> posesOfFrame(int frame, int steps) {
  std::vector<HeadPose> poses;
  for (int k = 1; k <= steps; ++k)
    poses.push_back(interpolate(poseAfter(frame - 1), poseAfter(frame), double(k) / steps));
  return poses;
}

Result<Simulation> simulationOf(const Groom& groom, Kind kind) {
  return Simulation::create(*device, groom, {}, settingsOf(kind), {.bodies = bodiesOf(kind)});
}

template <class Real>
std::vector<Vec3d> referenceAfter(const Groom& groom, Kind kind, const std::vector<HeadPose>& poses) {
  const auto bodies = bodiesOf(kind);
  reference::Simulation<Real> simulation(groom, {}, settingsOf(kind), {}, {}, {}, bodies);
  simulation.stepFrame(poses);
  std::vector<Vec3d> places;
  for (const auto& p : simulation.positions())
    places.push_back({double(p.x()), double(p.y()), double(p.z())});
  return places;
}

// The largest distance of a particle, share of a strand's length.
template <class Place>
double distance(const std::vector<Place>& found, const std::vector<Vec3d>& expected) {
  double largest = 0;
  for (std::size_t i = 0; i < found.size(); ++i)
    largest = std::max(largest, length(static_cast<Vec3d>(found[i]) - expected[i]));
  return largest / kStrandLength;
}

// Against the double reference. With contacts it may be further from it by as much as the float reference is:
// whether two spheres touch yet is then a matter of rounding.
Status verify(int strands, int particles, Kind kind) {
  const Groom groom = headOf(std::min(strands, kMostVerifiedStrands), particles);
  auto simulation = simulationOf(groom, kind);
  if (!simulation) return simulation.error();
  const auto poses = posesOfFrame(1, settingsOf(kind).stepsPerFrame);
  if (Status status = simulation->stepFrame(poses); !status) return status;
  const auto found = simulation->positions();
  if (!found) return found.error();
  const auto expected = referenceAfter<double>(groom, kind, poses);
  double allowed = kind == Kind::bodies ? kAgreementAmongBodies : kAgreement;
  if (hasContacts(kind)) allowed += distance(referenceAfter<float>(groom, kind, poses), expected);
  const double off = distance(*found, expected);
  if (off <= allowed) return {};
  return Error{fmt::format(
      "{:.1e} of a strand's length from the double reference after a frame, {:.0e} is allowed; not timed",
      off, allowed)};
}

struct FrameSamples {
  std::map<std::string, std::vector<double>> stages;  // [ms]
  std::vector<double> device, wall, readback, cpu;    // [ms]
};

Status timeFrame(Simulation& simulation, int frame, FrameSamples& samples) {
  const auto poses = posesOfFrame(frame, Settings{}.stepsPerFrame);
  auto before = Diagnostics(simulation).stageMilliseconds();
  const double cpu = processCpuSeconds(), start = wallSeconds();
  if (Status status = simulation.stepFrame(poses); !status) return status;
  const double stepped = wallSeconds();
  if (const auto positions = simulation.positions(); !positions) return positions.error();
  const double end = wallSeconds();
  samples.cpu.push_back(1e3 * (processCpuSeconds() - cpu));
  samples.wall.push_back(1e3 * (end - start));
  samples.readback.push_back(1e3 * (end - stepped));
  double sum = 0;
  for (const auto& [stage, milliseconds] : Diagnostics(simulation).stageMilliseconds()) {
    samples.stages[stage].push_back(milliseconds - before[stage]);
    if (stage != kCopyStage) sum += milliseconds - before[stage];
  }
  samples.device.push_back(sum);
  return {};
}

void report(benchmark::State& state, FrameSamples& samples) {
  const double strand = median(samples.stages["strand_step"]);
  double contact = 0;
  for (const auto& [stage, values] : samples.stages) {
    if (stage.starts_with("contact")) contact += median(values);
  }
  state.counters["device_ms"] = median(samples.device);
  state.counters["strand_ms"] = strand;
  state.counters["contact_ms"] = contact;
  state.counters["copy_ms"] = samples.stages.contains(kCopyStage) ? median(samples.stages[kCopyStage]) : 0;
  state.counters["wall_ms"] = median(samples.wall);
  state.counters["readback_ms"] = median(samples.readback);
  state.counters["cpu_ms"] = median(samples.cpu);
}

void frames(benchmark::State& state, int strands, int particles, Kind kind) {
  if (Status status = verify(strands, particles, kind); !status)
    return state.SkipWithError(status.error().message.c_str());
  auto simulation = simulationOf(headOf(strands, particles), kind);
  if (!simulation) return state.SkipWithError(simulation.error().message.c_str());
  FrameSamples samples;
  int frame = 1;
  // Drivers compile at the first dispatch, and lists grow.
  for (; frame <= 2; ++frame) {
    if (Status status = timeFrame(*simulation, frame, samples); !status)
      return state.SkipWithError(status.error().message.c_str());
  }
  samples = {};
  for (auto _ : state) {
    if (Status status = timeFrame(*simulation, frame++, samples); !status)
      return state.SkipWithError(status.error().message.c_str());
  }
  report(state, samples);
}

void registerAll() {
  const std::pair<const char*, Kind> kinds[] = {{"hair", Kind::hair},
                                                {"contacts", Kind::contacts},
                                                {"explicit", Kind::explicitContacts},
                                                {"bodies", Kind::bodies}};
  const std::pair<int, int> grooms[] = {{1'000, 64}, {1'500, 64}, {10'000, 32}, {100'000, 16}};
  for (const auto& [name, kind] : kinds) {
    for (const auto& [strands, particles] : grooms) {
      if (kind != Kind::hair && strands > 10'000) continue;
      benchmark::RegisterBenchmark(fmt::format("{}/{}x{}", name, strands, particles).c_str(), frames, strands,
                                   particles, kind)
          ->Unit(benchmark::kMillisecond)
          ->Iterations(kFrames);
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  return runOnDevice(argc, argv, "step_bench", device, [] {
    fmt::print("{} cores; heads of curls, 24 frames a second, 8 steps a frame\n", coreCount());
    registerAll();
  });
}
