// rest/strand_order.h: orders are orders, the curve is Hilbert's, the greedy step never loses; and what they
// gain.
#include "ringlet/rest/strand_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <string>

#include "ringlet/groom/generate.h"
#include "tests/rest/contact_samples.h"

namespace ringlet {
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

// The same overlaps in another order of the groom's strands.
std::vector<StrandOverlap> reordered(std::vector<StrandOverlap> overlaps, const RestState& rest,
                                     const std::vector<std::uint32_t>& order) {
  std::vector<std::uint32_t> places(order.size());
  for (std::uint32_t k = 0; k < order.size(); ++k) places[order[k]] = k;
  for (StrandOverlap& o : overlaps) {
    const std::uint32_t a = places[rest.strandInGroom[o.a]], b = places[rest.strandInGroom[o.b]];
    o = {std::min(a, b), std::max(a, b), o.count};
  }
  return overlaps;
}

TEST(StrandOrder, IsByLengthFirstAndTheSameTwice) {
  for (const ContactSample& sample : contactSamples()) {
    const auto order = orderAlongCurve(sample.groom);
    expectDeviceOrder(order, sample.groom);
    EXPECT_EQ(order, orderAlongCurve(sample.groom)) << sample.name;
    const RestState rest = restOf(sample.groom, order);
    const auto improved = improveOrder(rest, overlapsOf(rest), 10);
    expectDeviceOrder(improved, sample.groom);
    EXPECT_EQ(improved, improveOrder(rest, overlapsOf(rest), 10)) << sample.name;
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

TEST(StrandOrder, TheGreedyStepOnlyShortens) {
  // A row of strands, each of which overlaps the next, in random order.
  const int count = 300;
  std::vector<int> places(count);
  std::iota(places.begin(), places.end(), 0);
  std::shuffle(places.begin(), places.end(), std::mt19937(32));
  Groom groom = metres();
  for (int place : places) groom.addStrand(line({0.01 * place, 0, 0}, {0.01 * place, -0.1, 0}, 20));
  RestState rest = restOf(groom);
  double before = nearness(overlapsOf(rest)).meanDistance;
  for (int k = 0; k < 20; ++k) {
    rest = restOf(groom, improveOrder(rest, overlapsOf(rest), 1));
    const double now = nearness(overlapsOf(rest)).meanDistance;
    EXPECT_LE(now, before);
    before = now;
  }
  EXPECT_LT(before, 30) << "of about 100 in random order";
}

TEST(StrandOrder, WhatItGainsOnAHead) {
  const auto groom = makeHead({.strandCount = 1500});
  ASSERT_TRUE(groom) << groom.error().message;
  const auto curve = orderAlongCurve(*groom);
  const RestState rest = restOf(*groom, curve);
  const auto overlaps = overlapsOf(rest);
  const auto print = [&](const std::string& name, const std::vector<std::uint32_t>& order) {
    const Nearness n = nearness(reordered(overlaps, rest, order));
    std::printf("%-24s mean distance of overlapping strands %5.1f, within 64 places %4.1f %%\n", name.c_str(),
                n.meanDistance, 100 * n.nearShare);
    return n;
  };
  std::vector<std::uint32_t> order(groom->strandCount());
  std::iota(order.begin(), order.end(), 0u);
  const Nearness inGroom = print("groom", order);
  std::shuffle(order.begin(), order.end(), std::mt19937(33));
  print("random", order);
  const Nearness alongCurve = print("curve", curve);
  EXPECT_LT(alongCurve.meanDistance, 0.7 * inGroom.meanDistance);
  for (int passes : {1, 5, 20, 100}) {
    const Nearness greedy =
        print("curve and " + std::to_string(passes) + " passes", improveOrder(rest, overlaps, passes));
    EXPECT_LE(greedy.meanDistance, alongCurve.meanDistance);
  }
}

}  // namespace
}  // namespace ringlet
