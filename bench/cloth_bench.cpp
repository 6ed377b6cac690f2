// Hair that lies on cloth: first it falls onto a sheet that waves, then frames are timed in turn with those
// of the same hair without the sheet, and after each no particle may be below it. Medians. Run:
// build/release/bench/cloth_bench
//
// * strands (of 48 particles), triangles.
// * lying: percentage of particles that lie on the sheet, within 3 mm.
// * frame_ms, cloth_near_ms, tree_ms, strand_ms: device time of a frame of eight steps, and of its stages.
// * over_free, cpu_over_free: device and CPU time over those of the same hair without the sheet.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "bench/clocks.h"
#include "bench/device_main.h"
#include "parity/sample_bodies.h"
#include "ringlet/solver/diagnostics.h"
#include "ringlet/solver/simulation.h"

namespace {

using namespace ringlet;
using namespace ringlet::bench;

ComputeDevice* device = nullptr;

constexpr double kSheet = 0.4, kStrand = 0.25, kDrop = 0.03;  // [m]
constexpr int kParticles = 48, kFallingFrames = 20;

Groom hairAbove(int strands) {
  Groom groom;
  groom.metresPerUnit = 1;
  for (int s = 0; s < strands; ++s) {
    const double z = 0.7 * kSheet * (double(s) / strands - 0.5);
    std::vector<Vec3f> points;
    for (int i = 0; i < kParticles; ++i) {
      const double u = double(i) / (kParticles - 1), turn = 2 * std::numbers::pi * 4 * u;
      points.push_back(static_cast<Vec3f>(
          Vec3d{-kStrand / 2 + kStrand * u, kDrop + 0.002 * std::cos(turn), z + 0.002 * std::sin(turn)}));
    }
    groom.addStrand(points);
  }
  return groom;
}

// Its points only go up and down.
std::vector<Vec3d> wavingSheet(const BendingMesh& sheet, double seconds) {
  std::vector<Vec3d> points = sheet.points;
  for (Vec3d& p : points) p.y += 0.008 * std::sin(25 * p.x + 6 * seconds) * std::min(1.0, 2 * seconds);
  return points;
}

// How far p is above the triangle of the sheet that it is over or under; beside the sheet none.
std::optional<double> above(const BendingMesh& sheet, const std::vector<Vec3d>& points, Vec3d p) {
  for (const auto& [ia, ib, ic] : sheet.surface.triangles) {
    const Vec3d a = points[sheet.surface.sources[ia]], b = points[sheet.surface.sources[ib]],
                c = points[sheet.surface.sources[ic]];
    const double area = (b.x - a.x) * (c.z - a.z) - (b.z - a.z) * (c.x - a.x);
    const double v = ((p.x - a.x) * (c.z - a.z) - (p.z - a.z) * (c.x - a.x)) / area;
    const double w = ((b.x - a.x) * (p.z - a.z) - (b.z - a.z) * (p.x - a.x)) / area;
    if (v < 0 || w < 0 || v + w > 1) continue;
    return p.y - (a.y + v * (b.y - a.y) + w * (c.y - a.y));
  }
  return std::nullopt;
}

struct Samples {
  std::map<std::string, std::vector<double>> stages;  // [ms]
  std::vector<double> frame, cpu;                     // [ms]
};

Status timeFrame(Simulation& hair, const BodyPoints& points, Samples& samples) {
  const std::vector<HeadPose> still(static_cast<std::size_t>(Settings{}.stepsPerFrame));
  auto before = Diagnostics(hair).stageMilliseconds();
  const double cpu = processCpuSeconds();
  if (Status stepped = hair.stepFrame(still, {}, {}, points); !stepped) return stepped;
  samples.cpu.push_back(1e3 * (processCpuSeconds() - cpu));
  double sum = 0;
  for (const auto& [stage, milliseconds] : Diagnostics(hair).stageMilliseconds()) {
    samples.stages[stage].push_back(milliseconds - before[stage]);
    sum += milliseconds - before[stage];
  }
  samples.frame.push_back(sum);
  return {};
}

// Percentage of particles that lie on the sheet. Errors: one is below it.
Result<double> lyingOn(const BendingMesh& sheet, const std::vector<Vec3d>& points, Simulation& hair) {
  const auto positions = hair.positions();
  if (!positions) return positions.error();
  std::size_t lying = 0;
  for (std::size_t i = 0; i < positions->size(); ++i) {
    const auto height = above(sheet, points, Vec3d((*positions)[i]));
    if (height && *height < 0)
      return Error{fmt::format("particle {} is {:.2f} mm below the sheet; not timed", i, -1e3 * *height)};
    lying += height && *height < 3e-3;
  }
  return 100.0 * double(lying) / double(positions->size());
}

void onCloth(benchmark::State& state) {
  const Body sheet = parity::sheet(kSheet, {}, static_cast<std::uint32_t>(state.range(1)));
  const Groom groom = hairAbove(static_cast<int>(state.range(0)));
  Settings settings;
  settings.gravityPreload = 0;
  auto lies = Simulation::create(*device, groom, {}, settings, {.bodies = {&sheet, 1}});
  auto free = Simulation::create(*device, groom, {}, settings);
  if (!lies || !free) return state.SkipWithError((lies ? free : lies).error().message.c_str());
  Samples onSheet, alone;
  double lying = 0;
  int frame = 0;
  const auto step = [&]() -> Status {
    const auto points = wavingSheet(*sheet.mesh, ++frame / settings.framesPerSecond);
    const std::span<const Vec3d> view(points);
    if (Status timed = timeFrame(*lies, {&view, 1}, onSheet); !timed) return timed;
    if (Status timed = timeFrame(*free, {}, alone); !timed) return timed;
    const auto found = lyingOn(*sheet.mesh, points, *lies);
    if (!found) return found.error();
    lying = *found;
    return {};
  };
  const auto stepOrSkip = [&] {
    const Status stepped = step();
    if (!stepped) state.SkipWithError(stepped.error().message.c_str());
    return bool(stepped);
  };
  while (frame < kFallingFrames)
    if (!stepOrSkip()) return;
  if (lying < 10) return state.SkipWithError(fmt::format("only {} % lie on the sheet", lying).c_str());
  onSheet = alone = {};
  for (auto _ : state)
    if (!stepOrSkip()) return;
  state.counters["triangles"] = double(sheet.mesh->surface.triangles.size());
  state.counters["lying"] = lying;
  state.counters["frame_ms"] = median(onSheet.frame);
  state.counters["cloth_near_ms"] = median(onSheet.stages["cloth_near"]);
  state.counters["strand_ms"] = median(onSheet.stages["strand_step"]);
  state.counters["over_free"] = medianRatio(onSheet.frame, alone.frame);
  state.counters["cpu_over_free"] = medianRatio(onSheet.cpu, alone.cpu);
}

}  // namespace

int main(int argc, char** argv) {
  return runOnDevice(argc, argv, "cloth_bench", device, [] {
    for (const int strands : {150, 600})
      for (const int cells : {12, 30, 60})
        benchmark::RegisterBenchmark("on_cloth", onCloth)
            ->ArgNames({"strands", "cells"})
            ->Args({strands, cells})
            ->Unit(benchmark::kMillisecond)
            ->Iterations(15);
  });
}
