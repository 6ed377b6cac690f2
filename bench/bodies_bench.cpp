// Grids of bodies that bend: first that they agree with the double reference, then how long a build takes, in
// turn with nothing between, medians. Run: build/release/bench/bodies_bench
//
// * triangles, cells: of the mesh, a sphere; along the longest side of its grid.
// * device_ms, cpu_ms: of one build; device time (of a frame's four), CPU time of all cores.
// * host_grid_ms: makeDistanceGrid of the same mesh and cells, one thread. over_host_by_cpu: times faster.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "bench/clocks.h"
#include "bench/device_main.h"
#include "reference/kernels/mesh_field.h"
#include "ringlet/base/packed.h"
#include "ringlet/bodies/close_mesh.h"
#include "ringlet/bodies/icosphere.h"
#include "ringlet/bodies/mesh_grid.h"
#include "ringlet/gpu/device_buffers.h"
#include "ringlet/gpu/recorder.h"
#include "ringlet/solver/compute_device.h"
#include "ringlet/solver/inputs/mesh_fields.h"

namespace {

using namespace ringlet;
using namespace ringlet::bench;

ComputeDevice* device = nullptr;

constexpr std::uint32_t kBuilds = 4;
constexpr double kRadius = 0.1;

TriangleMesh sphereOf(int frequency) {
  TriangleMesh mesh = makeIcosphere(frequency);
  for (Vec3d& p : mesh.points) p = p * kRadius;
  return mesh;
}

BendingMesh bendingMeshOf(const TriangleMesh& mesh, int cells) {
  BendingMesh made;
  made.surface = closed(mesh);
  made.points = mesh.points;
  made.cell = 2 * kRadius / cells;
  const auto count = static_cast<std::uint32_t>(cells) + 6;
  made.counts = {count, count, count};
  made.origin = Vec3d{-1, -1, -1} * (made.cell * count / 2);
  made.reach = kRadius;
  return made;
}

// Each copy a little elsewhere.
std::vector<Vec3d> pointsOf(const BendingMesh& mesh, std::uint32_t copy) {
  std::vector<Vec3d> points = mesh.surface.pointsOf(mesh.points);
  for (Vec3d& p : points) p += Vec3d{0.3, -0.2, 0.4} * (mesh.cell * copy);
  return points;
}

// The largest difference of distances from the reference's [cells].
double errorOf(const BendingMesh& mesh, const std::vector<std::uint32_t>& keys,
               const layout::MeshRest& rest) {
  const auto expected = reference::meshField<double>(mesh, pointsOf(mesh, 0), double{layout::kMeshBand});
  const double most = std::pow(2.0, 32 - rest.triangleBits) - 2;
  double worst = 0;
  for (std::size_t i = 0; i < expected.distances.size(); ++i) {
    const std::uint32_t key = keys[i];
    const double steps = most + 1 - double(key >> rest.triangleBits);
    const double found = key == 0 ? double{layout::kMeshBand} : double{layout::kMeshBand} * steps / most;
    // Deeper inside than the band distances go on without a triangle.
    worst = std::max(worst,
                     std::abs(found - std::min(std::abs(expected.distances[i]), double{layout::kMeshBand})));
  }
  return worst;
}

void build(benchmark::State& state) {
  const TriangleMesh mesh = sphereOf(static_cast<int>(state.range(0)));
  const BendingMesh bending = bendingMeshOf(mesh, static_cast<int>(state.range(1)));
  std::vector<layout::vec4> points;
  for (std::uint32_t copy = 0; copy < kBuilds; ++copy)
    for (const Vec3d p : pointsOf(bending, copy)) points.push_back(packed(p));
  gpu::Device& gpu = device->gpu();
  auto pointBuffer = createFilled(gpu, points, "points");
  auto pairs =
      gpu::Buffer::create(gpu, kBuilds * bending.cornerCount() * 4, gpu::BufferKind::storage, "pairs");
  if (!pointBuffer || !pairs) return state.SkipWithError("no memory");
  const BendingMesh* one = &bending;
  auto fields = MeshFields::create(gpu, std::span(&one, 1), kBuilds, *pointBuffer, *pairs);
  if (!fields) return state.SkipWithError(fields.error().message.c_str());
  auto recorder = gpu::Recorder::create(gpu, "fields");
  if (!recorder || !recorder->begin()) return state.SkipWithError("no recorder");
  recorder->beginStage("fields");
  fields->record(*recorder, 0, kBuilds - 1);
  recorder->endStage();
  if (!recorder->submitAndWait()) return state.SkipWithError("the device failed");
  const double error = errorOf(bending, *downloadAll<std::uint32_t>(fields->keys(), bending.cornerCount()),
                               fields->rests()[0]);
  if (!(error < 1e-3)) return state.SkipWithError(fmt::format("{} cells off the reference", error).c_str());

  std::vector<double> onDevice, cpu, host;
  for (auto _ : state) {
    const double before = processCpuSeconds();
    if (!recorder->submit() || !recorder->wait()) return state.SkipWithError("the device failed");
    cpu.push_back((processCpuSeconds() - before) / kBuilds);
    for (const auto& [stage, milliseconds] : recorder->stageMilliseconds())
      if (stage == "fields") onDevice.push_back(milliseconds / kBuilds);
    if (host.size() >= 3) continue;
    const double start = processCpuSeconds();
    if (!makeDistanceGrid(mesh, {.cells = static_cast<int>(state.range(1)), .threadCount = 1}))
      return state.SkipWithError("no grid");
    host.push_back(processCpuSeconds() - start);
  }
  state.counters["triangles"] = double(mesh.triangles.size());
  state.counters["device_ms"] = median(onDevice);
  state.counters["cpu_ms"] = 1e3 * median(cpu);
  state.counters["host_grid_ms"] = 1e3 * median(host);
  state.counters["over_host_by_cpu"] = median(host) / median(cpu);
}

}  // namespace

int main(int argc, char** argv) {
  return runOnDevice(argc, argv, "bodies_bench", device, [] {
    for (const int frequency : {8, 16, 32})
      for (const int cells : {48, 64, 96})
        benchmark::RegisterBenchmark("field_build", build)
            ->ArgNames({"frequency", "cells"})
            ->Args({frequency, cells})
            ->Unit(benchmark::kMillisecond)
            ->Iterations(15);
  });
}
