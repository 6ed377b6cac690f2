// rest/strand_order.h: orders are orders, the curve is Hilbert's, and it brings overlapping strands together.
#include "ringlet/rest/strand_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <string>

#include "ringlet/groom/generate.h"
#include "ringlet/rest/contact_graph.h"
#include "tests/rest/contact_samples.h"

namespace ringlet::strand_order_test {
namespace {

using namespace test;

void expectDeviceOrder(const std::vector<std::uint32_t>& order, const Groom& groom) {
  std::vector<std::uint32_t> sorted = order, all(groom.strandCount());
  std::ranges::sort(sorted);
  std::iota(all.begin(), all.end(), 0u);
  EXPECT_EQ(sorted, all);
  EXPECT_TRUE(std::ranges::is_sorted(order, {}, [&](std::uint32_t s) { return groom.strand(s).size(); }));
}

std::vector<StrandOverlap> overlapsOf(const RestState& rest) {
  return countOverlaps(rest, chooseContactParticles(rest, {}), 1.5);
}

// How near overlapping strands are in memory.
struct Nearness {
  double meanDistance = 0;  // over overlaps, of places
  double nearShare = 0;     // of overlaps within 64 places
};
Nearness nearness(std::span<const StrandOverlap> overlaps) {
  Nearness n;
  for (const StrandOverlap& o : overlaps) {
    n.meanDistance += (o.b - o.a) / static_cast<double>(overlaps.size());
    n.nearShare += (o.b - o.a <= 64) / static_cast<double>(overlaps.size());
  }
  return n;
}

TEST(StrandOrder, IsByLengthFirstAndTheSameTwice) {
  for (const ContactSample& sample : contactSamples()) {
    const auto order = orderAlongCurve(sample.groom);
    expectDeviceOrder(order, sample.groom);
    EXPECT_EQ(order, orderAlongCurve(sample.groom)) << sample.name;
  }
}

TEST(StrandOrder, GoesFromCellToCellBesideIt) {
  // Hilbert's curve visits a lattice of a power of two in steps of one.
  Groom lattice = metres();
  const int n = 8;
  for (int i = 0; i < n * n * n; ++i) {
    const Vec3d at{double(i % n), double(i / n % n), double(i / n / n)};
    lattice.addStrand(line(at + Vec3d{0.1, 0, 0}, at - Vec3d{0.1, 0, 0}, 2));
  }
  const auto order = orderAlongCurve(lattice);
  for (std::size_t k = 1; k < order.size(); ++k) {
    const Vec3f step = lattice.strand(order[k])[0] - lattice.strand(order[k - 1])[0];
    EXPECT_NEAR(length(step), 1, 1e-6) << k;
  }
}

TEST(StrandOrder, OfStrandsInOnePlaceIsTheGrooms) {
  Groom groom = metres();
  for (int s = 0; s < 20; ++s) groom.addStrand(line({3, 4, 5}, {3, 4, 6}, 5));
  std::vector<std::uint32_t> expected(20);
  std::iota(expected.begin(), expected.end(), 0u);
  EXPECT_EQ(orderAlongCurve(groom), expected);
}

TEST(StrandOrder, OfARestStateIsThatAskedFor) {
  Groom groom = metres();
  addWandering(groom, 50, 6, {}, {0.1, 0, 0.1}, 0.01, 31);
  const auto order = orderAlongCurve(groom);
  const RestState plain = restOf(groom), asked = restOf(groom, order);
  EXPECT_EQ(asked.strandInGroom, order);
  for (std::size_t d = 0; d < order.size(); ++d) {
    const auto& strand = asked.strands[d];
    const auto same = std::ranges::find(plain.strandInGroom, order[d]) - plain.strandInGroom.begin();
    const auto& plainStrand = plain.strands[static_cast<std::size_t>(same)];
    EXPECT_EQ(strand.particleCount, plainStrand.particleCount);
    EXPECT_EQ(strand.bendStiffness, plainStrand.bendStiffness);
    EXPECT_EQ(asked.firstInGroom[d], groom.firstPoint[order[d]]);
    for (std::uint32_t i = 0; i < strand.particleCount; ++i)
      EXPECT_EQ(asked.points[strand.firstParticle + i], plain.points[plainStrand.firstParticle + i]);
  }
}

TEST(StrandOrder, BringsOverlappingStrandsTogether) {
  const auto groom = makeHead({.strandCount = 1500});
  ASSERT_TRUE(groom) << groom.error().message;
  const auto nearnessIn = [&](const char* name, const RestState& rest) {
    const Nearness n = nearness(overlapsOf(rest));
    std::printf("%-12s mean distance of overlapping strands %5.1f, within 64 places %4.1f %%\n", name,
                n.meanDistance, 100 * n.nearShare);
    return n.meanDistance;
  };
  const double inGroom = nearnessIn("groom", restOf(*groom));
  EXPECT_LT(nearnessIn("curve", restOf(*groom, orderAlongCurve(*groom))), 0.7 * inGroom);
}

}  // namespace
}  // namespace ringlet::strand_order_test
