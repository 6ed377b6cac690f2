// The sums at the nodes of the volume's grid: the same bits in whatever order parcels stand in a cell, and
// however they are divided among devices. Mirrors shaders/kernels/volume_rank.comp, volume_order.comp,
// volume_gather.comp, volume_nodes.comp and volume_mean.comp.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "layout/contacts.h"
#include "layout/volume.h"
#include "ringlet/gpu/device_buffers.h"
#include "ringlet/gpu/recorder.h"
#include "ringlet/solver/contacts/volume_kernels.h"
#include "tests/support/gpu_test.h"

namespace ringlet::test::volume_gather_test {
namespace {

constexpr std::uint32_t kSide = 5, kNodes = kSide * kSide * kSide, kCells = layout::kBucketBlock;
constexpr std::uint32_t kGroups = (kNodes + kVolumeGroupSize - 1) / kVolumeGroupSize;
constexpr std::size_t kParcels = 4000;
constexpr float kMostRate = 32;

struct InCell {
  std::uint32_t cell = 0;
  layout::VolumeParcel parcel;
  float mass = 0;
};

// Columns of C [1/s].
std::array<std::array<double, 3>, 3> gradientOf(const layout::VolumeParcel& p) {
  return {{{p.gradientX.x, p.gradientX.y, p.gradientX.z},
           {p.gradientY.x, p.gradientY.y, p.gradientY.z},
           {p.place.w, p.gradientX.w, p.gradientY.w}}};
}

// Parcels all over the cells, some as large as there may be, in an order of their own within each cell.
std::vector<InCell> randomParcels(std::uint32_t orderSeed) {
  std::mt19937 random(3), order(orderSeed);
  std::uniform_real_distribution<float> place(0, kSide - 1 - 1e-3f), share(-1, 1);
  std::vector<InCell> all;
  for (std::size_t k = 0; k < kParcels; ++k) {
    const float x = place(random), y = place(random), z = place(random);
    const float units = k % 7 == 0 ? float(layout::kVolumeUnits) : 1e6f * std::exp(6 * share(random));
    const auto cell = (std::uint32_t(z) * kSide + std::uint32_t(y)) * kSide + std::uint32_t(x);
    const layout::vec4 rate{units * share(random), units * share(random), units * share(random), units};
    // Some parcels are cut at the largest rate.
    const auto c = [&] { return 16 * share(random); };
    all.push_back({cell, {rate, {x, y, z, c()}, {c(), c(), c(), c()}, {c(), c(), c(), c()}}, units});
  }
  std::shuffle(all.begin(), all.end(), order);
  std::ranges::stable_sort(all, {}, &InCell::cell);
  return all;
}

class VolumeGather : public GpuTest {
 protected:
  struct Nodes {
    std::vector<layout::vec4> nodes;
    std::vector<std::int32_t> sums;
  };

  // The nodes from these parcels; of divided strands from their sums, to which `others` are added.
  Nodes nodesFrom(const std::vector<InCell>& parcels, bool texels, bool forGpu, bool divided,
                  const std::vector<std::int32_t>& others = {}) {
    std::vector<std::uint32_t> words(kCells), starts(kCells + 1);
    std::vector<layout::VolumeParcel> stand;
    for (const InCell& each : parcels) stand.push_back(each.parcel), ++starts[each.cell + 1];
    for (std::uint32_t cell = 0; cell < kCells; ++cell) starts[cell + 1] += starts[cell];
    words.insert(words.end(), starts.begin(), starts.end() - 1);
    words.push_back(0);
    words.resize(words.size() + 2 * kParcels);
    for (const InCell& each : parcels) words.push_back(std::bit_cast<std::uint32_t>(each.mass));
    words.resize(words.size() + kParcels - parcels.size() + layout::kCellBins + 3 * kCells);
    layout::VolumeControl control{};
    control.cellCount = kNodes;
    control.cellsPerMetre = 1, control.cell = 1;
    for (std::uint32_t& size : control.size) size = kSide;
    auto halt = createZero(gpu(), sizeof(layout::ContactControl), "halt");
    auto unused = createZero(gpu(), 4096, "unused");
    auto cells = createFilled(gpu(), words, "cells");
    auto all = createFilled(gpu(), stand, "parcels");
    auto nodes = createZero(gpu(), kNodes * sizeof(layout::vec4), "nodes");
    auto sums = createZero(gpu(), 10 * kCells * sizeof(std::int32_t), "sums");
    auto corners = createZero(gpu(), kCells * layout::kCornerSumsOfCell * sizeof(layout::vec4), "corners");
    auto block = createFilled(gpu(), std::vector{control}, "control");
    EXPECT_TRUE(halt && unused && cells && all && nodes && sums && corners && block);
    layout::VolumeNumbers numbers{};
    numbers.count = kParcels, numbers.cellCapacity = kCells;
    numbers.mostRate = kMostRate, numbers.unitsPerMass = 1, numbers.unitsPerGain = 1;
    auto ofNumbers = createFilled(gpu(), std::vector{numbers}, "numbers");
    EXPECT_TRUE(ofNumbers);
    const auto run = [&](VolumeKernel which, std::uint32_t groups = kGroups) {
      auto kernel = gpu::Kernel::create(gpu(), describeVolumeKernel(which, texels, forGpu, divided));
      EXPECT_TRUE(kernel);
      gpu::BufferTable buffers{
          {layout::kBindVolumeCells, *cells},        {layout::kBindVolumeCellTexels, *cells},
          {layout::kBindVolumeParcels, *all},        {layout::kBindVolumeParcelTexels, *all},
          {layout::kBindVolumeNodes, *nodes},        {layout::kBindVolumeSums, *sums},
          {layout::kBindVolumeCornerSums, *corners}, {layout::kBindVolumeCornerSumTexels, *corners},
          {layout::kBindVolumeControl, *block},      {layout::kBindVolumeHalt, *halt},
          {layout::kBindVolumeNumbers, *ofNumbers}};
      for (const auto& [number, kind] : (*kernel)->bindings()) buffers.emplace(number, *unused);
      auto bindings = gpu::Bindings::create(**kernel, buffers);
      auto recorder = gpu::Recorder::create(gpu(), "nodes");
      EXPECT_TRUE(bindings && recorder && recorder->begin());
      recorder->dispatch(**kernel, *bindings, layout::VolumeParameters{0, 1}, groups);
      EXPECT_TRUE(recorder->submitAndWait());
    };
    run(VolumeKernel::rank);
    run(VolumeKernel::order);
    const layout::VolumeControl ordered = downloadAll<layout::VolumeControl>(*block, 1)->front();
    EXPECT_EQ(ordered.filled, (kSide - 1) * (kSide - 1) * (kSide - 1));
    EXPECT_EQ(ordered.reached, kNodes);
    run(VolumeKernel::gather, ordered.indirectFilled[0]);
    run(VolumeKernel::nodes, divided ? kGroups : ordered.indirectReached[0]);
    Nodes result;
    result.sums = *downloadAll<std::int32_t>(*sums, 10 * kCells);
    if (!others.empty()) {
      std::vector<std::int32_t> both = result.sums;
      for (std::size_t k = 0; k < both.size(); ++k) both[k] += others[k];
      EXPECT_TRUE(sums->upload(std::as_bytes(std::span(both))));
      run(VolumeKernel::mean);
    }
    result.nodes = *downloadAll<layout::vec4>(*nodes, kNodes);
    return result;
  }
};

void expectSameBits(const std::vector<layout::vec4>& a, const std::vector<layout::vec4>& b) {
  for (std::size_t n = 0; n < kNodes; ++n)
    EXPECT_EQ((std::array{a[n].x, a[n].y, a[n].z, a[n].w}), (std::array{b[n].x, b[n].y, b[n].z, b[n].w}))
        << "node " << n;
}

// Nor on who adds them up.
TEST_F(VolumeGather, DoesNotDependOnTheOrderOfParcels) {
  for (const bool texels : {false, true}) {
    const auto one = nodesFrom(randomParcels(1), texels, false, false);
    for (const bool forGpu : {false, true})
      expectSameBits(one.nodes, nodesFrom(randomParcels(2), texels, forGpu, false).nodes);
  }
}

TEST_F(VolumeGather, IsTheMeanInDouble) {
  const auto parcels = randomParcels(1);
  const auto found = nodesFrom(parcels, true, false, false).nodes;
  int cut = 0;
  for (std::uint32_t n = 0; n < kNodes; ++n) {
    const std::array<double, 3> at{double(n % kSide), double(n / kSide % kSide), double(n / kSide / kSide)};
    std::array<double, 4> sum{};
    double mass = 0;
    for (const auto& [cell, parcel, ofParcel] : parcels) {
      const auto hat = [](double x) { return std::max(0.0, 1 - std::abs(x)); };
      const double weight =
          hat(parcel.place.x - at[0]) * hat(parcel.place.y - at[1]) * hat(parcel.place.z - at[2]);
      const std::array<double, 3> apart{at[0] - parcel.place.x, at[1] - parcel.place.y,
                                        at[2] - parcel.place.z};
      const double rates[]{parcel.rate.x, parcel.rate.y, parcel.rate.z};
      for (int axis = 0; axis < 3; ++axis) {
        double rate = rates[axis];
        for (int k = 0; k < 3; ++k)
          rate += parcel.rate.w / kMostRate * gradientOf(parcel)[std::size_t(k)][std::size_t(axis)] *
                  apart[std::size_t(k)];
        cut += std::abs(rate) > parcel.rate.w;
        sum[std::size_t(axis)] += weight * std::clamp<double>(rate, -parcel.rate.w, parcel.rate.w);
      }
      sum[3] += weight * parcel.rate.w;
      mass += weight * ofParcel;
    }
    EXPECT_NEAR(found[n].x, kMostRate * sum[0] / sum[3], 1e-5);
    EXPECT_NEAR(found[n].y, kMostRate * sum[1] / sum[3], 1e-5);
    EXPECT_NEAR(found[n].z, kMostRate * sum[2] / sum[3], 1e-5);
    EXPECT_NEAR(found[n].w, mass, 1e-6 * mass);
  }
  EXPECT_GT(cut, 100) << "no rate is cut, and that is not tested";
}

TEST_F(VolumeGather, DoesNotDependOnHowParcelsAreDivided) {
  const auto all = randomParcels(1);
  std::vector<InCell> some, rest;
  for (std::size_t k = 0; k < all.size(); ++k) (k % 3 == 0 ? some : rest).push_back(all[k]);
  for (const bool forGpu : {false, true}) {
    const auto others = nodesFrom(rest, true, forGpu, true);
    expectSameBits(nodesFrom(some, true, forGpu, true, others.sums).nodes,
                   nodesFrom(all, true, false, false).nodes);
  }
}

}  // namespace
}  // namespace ringlet::test::volume_gather_test
