// The order of the volume's particles inside a cell: by index, whichever thread came first. Mirrors
// shaders/kernels/volume_order.comp.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <utility>
#include <vector>

#include "layout/contacts.h"
#include "layout/volume.h"
#include "ringlet/gpu/device_buffers.h"
#include "ringlet/gpu/recorder.h"
#include "ringlet/solver/volume_kernels.h"
#include "tests/support/gpu_test.h"

namespace ringlet::test {
namespace {

constexpr std::uint32_t kParticles = 500, kCells = layout::kBucketBlock, kUsedCells = 9;

// The cells as volume_scatter.comp leaves them (shared/volume_buffers.glsl), with the particles of each in an
// order of their own; and, of each place, the particle that should stand there.
struct Cells {
  std::vector<std::uint32_t> words;
  std::vector<std::uint32_t> ascending;
};
Cells shuffledCells() {
  std::mt19937 random(3);
  std::vector<std::vector<std::uint32_t>> inCell(kCells);
  std::vector<std::uint32_t> cellOf, ranks(kParticles), entries;
  for (std::uint32_t i = 0; i < kParticles; ++i) {
    cellOf.push_back(static_cast<std::uint32_t>(random() % kUsedCells));
    inCell[cellOf.back()].push_back(i);
  }
  Cells cells;
  cells.words.resize(kCells);  // counts, zero again
  for (std::vector<std::uint32_t>& cell : inCell) {
    cells.words.push_back(static_cast<std::uint32_t>(entries.size()));
    cells.ascending.insert(cells.ascending.end(), cell.begin(), cell.end());
    std::shuffle(cell.begin(), cell.end(), random);
    for (std::uint32_t k = 0; k < cell.size(); ++k) ranks[cell[k]] = k;
    entries.insert(entries.end(), cell.begin(), cell.end());
  }
  cells.words.push_back(0);  // of the block's sum, used up
  for (const auto* part : {&std::as_const(cellOf), &std::as_const(ranks), &std::as_const(entries)})
    cells.words.insert(cells.words.end(), part->begin(), part->end());
  return cells;
}

using VolumeOrder = GpuTest;

TEST_F(VolumeOrder, IsByIndexInEveryCell) {
  const Cells cells = shuffledCells();
  std::vector<layout::VolumeParticle> particles(kParticles);
  std::vector<layout::vec4> brought;
  for (std::uint32_t i = 0; i < kParticles; ++i) {
    particles[i].mass = float(i);
    brought.push_back({float(i), 1, 2, 3});
  }
  for (const bool texels : {false, true}) {
    auto kernel = gpu::Kernel::create(gpu(), describeVolumeKernel(VolumeKernel::order, texels));
    auto unused = createZero(gpu(), kParticles * sizeof(layout::VolumeState), "unused");
    auto halt = createZero(gpu(), sizeof(layout::ContactControl), "halt");
    auto particle = createFilled(gpu(), particles, "particles");
    auto rate = createFilled(gpu(), brought, "brought");
    auto words = createFilled(gpu(), cells.words, "cells");
    auto parcels = createZero(gpu(), kParticles * sizeof(layout::VolumeParcel), "parcels");
    auto located = createZero(gpu(), kParticles * sizeof(layout::uvec4), "located");
    ASSERT_TRUE(kernel && unused && halt && particle && rate && words && parcels && located);
    gpu::BufferTable buffers{
        {layout::kBindVolumeParticles, *particle}, {layout::kBindVolumeParticleTexels, *particle},
        {layout::kBindVolumeBrought, *rate},       {layout::kBindVolumeBroughtTexels, *rate},
        {layout::kBindVolumeCells, *words},        {layout::kBindVolumeCellTexels, *words},
        {layout::kBindVolumeParcels, *parcels},    {layout::kBindVolumeLocated, *located},
        {layout::kBindVolumeHalt, *halt}};
    for (const auto& [number, kind] : (*kernel)->bindings()) buffers.emplace(number, *unused);
    auto bindings = gpu::Bindings::create(**kernel, buffers);
    auto recorder = gpu::Recorder::create(gpu(), "order");
    ASSERT_TRUE(bindings && recorder && recorder->begin());
    layout::VolumeParameters parameters{};
    parameters.count = kParticles, parameters.cellCapacity = kCells;
    recorder->dispatch(**kernel, *bindings, parameters, (kParticles + 63) / 64);
    ASSERT_TRUE(recorder->submitAndWait());
    const auto stand = *downloadAll<layout::VolumeParcel>(*parcels, kParticles);
    const auto at = *downloadAll<layout::uvec4>(*located, kParticles);
    for (std::uint32_t place = 0; place < kParticles; ++place) {
      const std::uint32_t i = cells.ascending[place];
      EXPECT_EQ(stand[place].rate.x, float(i)) << "place " << place;
      EXPECT_EQ(stand[place].place.w, float(i)) << "place " << place;
      EXPECT_EQ(at[i].w, place) << "particle " << i;
    }
  }
}

}  // namespace
}  // namespace ringlet::test
