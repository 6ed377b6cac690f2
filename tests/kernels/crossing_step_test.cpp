// Tests crossings/crossing_step.h: random pairs, tangles, hair that moves together, and what may
// cross.
#include "ringlet/crossings/crossing_step.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "tests/kernels/crossing_samples.h"

namespace ringlet::test::crossing_step_test {
namespace {

// Strands, where they are and want to be.
struct Tangle {
  CrossingHair hair{
      .firstPoint = {0}, .bundles = {}, .takesPart = {}, .masses = {}, .lengths = {}, .maxStretch = 1.1};
  std::vector<Vec3d> from, to;
  Quatd turn{};

  void addStrand(const std::vector<Vec3d>& points, const std::vector<Vec3d>& ends, std::size_t pinnedCount) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      from.push_back(asStored(points[i]));
      to.push_back(asStored(ends[i]));
      hair.masses.push_back(i < pinnedCount ? 0 : 1e-6);
      hair.lengths.push_back(i + 1 < points.size() ? length(points[i + 1] - points[i]) : 0);
    }
    hair.firstPoint.push_back(static_cast<std::uint32_t>(from.size()));
  }
  std::uint64_t crossings() const { return exactCrossings(hair.firstPoint, from, to); }
  // Of free particles: what the changes add to the momentum, as a share of the sum of their sizes.
  double momentumError(const std::vector<Vec3d>& wanted) const {
    Vec3d sum;
    double sizes = 0;
    for (std::size_t i = 0; i < to.size(); ++i)
      sum += hair.masses[i] * (to[i] - wanted[i]), sizes += hair.masses[i] * length(to[i] - wanted[i]);
    return sizes > 0 ? length(sum) / sizes : 0;
  }
  CrossingReport keepApart(const CrossingEffort& effort = {}) {
    return keepFromCrossing(hair, turn, from, to, effort);
  }
};

// Strands of 8 edges of 5 mm, a few mm apart, each on its way by up to `way`, in waves along it.
Tangle randomTangle(std::mt19937& random, int strandCount, double way, bool arePinned) {
  Tangle tangle;
  for (int s = 0; s < strandCount; ++s) {
    std::vector<Vec3d> points{inCube(random, 0.01)}, ends;
    const Vec3d along = anyDirection(random), first = inCube(random, way), second = inCube(random, way);
    for (int i = 0; i < 8; ++i)
      points.push_back(points.back() + 0.005 * normalizedOr(along + inCube(random, 0.5), along));
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double share = static_cast<double>(i) / 8;
      ends.push_back(arePinned && i == 0 ? points[i] : points[i] + (1 - share) * first + share * second);
    }
    tangle.addStrand(points, ends, arePinned);
  }
  return tangle;
}

TEST(CrossingStep, HoldsRandomPairs) {
  std::mt19937 random(11);
  int crossed = 0;
  for (int trial = 0; trial < 100'000; ++trial) {
    const MovedPair pair = randomPair(random);
    const bool isPinned = trial % 4 == 0;
    Tangle tangle;
    tangle.addStrand({pair.p.from[0], pair.p.from[1]}, {pair.p.to[0], pair.p.to[1]}, isPinned);
    tangle.addStrand({pair.q.from[0], pair.q.from[1]}, {pair.q.to[0], pair.q.to[1]}, false);
    if (isPinned) tangle.to[0] = tangle.from[0];
    crossed += tangle.crossings() > 0;
    const CrossingReport report = tangle.keepApart();
    ASSERT_EQ(tangle.crossings(), 0u) << trial;
    ASSERT_EQ(report.unsafe, 0u) << trial;
    ASSERT_EQ(report.heldSteps, 0u) << trial;
  }
  EXPECT_GT(crossed, 4'000);
}

TEST(CrossingStep, HoldsTangles) {
  std::mt19937 random(12);
  std::uint64_t crossings = 0;
  CrossingReport all;
  for (int trial = 0; trial < 40; ++trial) {
    const bool arePinned = trial % 4 < 2;
    Tangle tangle = randomTangle(random, 80, trial % 2 ? 0.008 : 0.002, arePinned);
    const std::vector<Vec3d> wanted = tangle.to;
    crossings += tangle.crossings();
    const CrossingReport report = tangle.keepApart();
    ASSERT_EQ(tangle.crossings(), 0u) << trial;
    for (const Vec3d& x : tangle.to) ASSERT_EQ(x, asStored(x)) << "what is judged is what is stored";
    if (!arePinned && report.heldSteps == 0) {
      EXPECT_LT(tangle.momentumError(wanted), 1e-3) << trial;
    }
    for (std::size_t i = 0; i < wanted.size(); ++i)
      if (tangle.hair.masses[i] == 0) {
        ASSERT_EQ(tangle.to[i], wanted[i]);
      }
    all.add(report);
  }
  EXPECT_EQ(all.unsafe, 0u);
  EXPECT_GT(crossings, 2'000u);
  EXPECT_GT(all.tied, 0u) << "some cannot be pushed apart";
  EXPECT_LE(all.heldSteps, 2u);
}

// Without pushes all that would cross is tied; without ties too, all goes as the head does.
TEST(CrossingStep, HoldsTanglesByTiesAlone) {
  std::mt19937 random(15);
  for (int trial = 0; trial < 20; ++trial) {
    for (const int rounds : {40, 0}) {
      Tangle tangle = randomTangle(random, 80, 0.004, trial % 2 == 0);
      tangle.turn = fromRotationVector(Vec3d{0, 0.1, 0});
      for (std::size_t i = 0; i < tangle.from.size(); ++i)
        if (tangle.hair.masses[i] == 0) tangle.to[i] = asStored(rotate(tangle.turn, tangle.from[i]));
      ASSERT_GT(tangle.crossings(), 0u);
      const std::vector<Vec3d> wanted = tangle.to;
      const CrossingReport report =
          tangle.keepApart({.pushPasses = 0, .turnsBetweenTies = 0, .tieRounds = rounds});
      ASSERT_EQ(tangle.crossings(), 0u) << trial;
      ASSERT_EQ(report.unsafe, 0u) << trial;
      ASSERT_EQ(report.heldSteps, rounds == 0 ? 1u : 0u) << trial;
      EXPECT_EQ(report.tied > 0, rounds > 0) << trial;
      if (trial % 2 == 1 && rounds > 0) {
        EXPECT_LT(tangle.momentumError(wanted), 1e-3) << trial;
      }
    }
  }
}

// Strands 1 mm apart that a turn and a shear carry 15 mm away.
TEST(CrossingStep, LeavesHairAloneThatMovesTogether) {
  const Quatd turn = fromRotationVector(Vec3d{0, 0.2, 0});
  Tangle tangle;
  for (int s = 0; s < 25; ++s) {
    std::vector<Vec3d> points, ends;
    for (int i = 0; i < 20; ++i) {
      const Vec3d x{0.001 * (s % 5), -0.005 * i, 0.001 * (s / 5)};
      points.push_back(x);
      ends.push_back(rotate(turn, x) + Vec3d{0.015 + 0.1 * x.z, 0, 0});
    }
    tangle.addStrand(points, ends, false);
  }
  const std::vector<Vec3d> wanted = tangle.to;
  const CrossingReport report = tangle.keepApart();
  EXPECT_EQ(report.changed, 0u);
  EXPECT_EQ(tangle.to, wanted);
}

TEST(CrossingStep, LetsStrandsOfOneBundleAndThoseThatTakeNoPart) {
  std::mt19937 random(14);
  Tangle tangle = randomTangle(random, 16, 0.004, false);
  const std::vector<Vec3d> wanted = tangle.to;
  ASSERT_GT(tangle.crossings(), 0u);
  tangle.hair.bundles.assign(16, 3);
  tangle.keepApart();
  EXPECT_EQ(tangle.to, wanted);
  tangle.hair.bundles.clear();
  tangle.hair.takesPart.assign(16, false);
  tangle.keepApart();
  EXPECT_EQ(tangle.to, wanted);
}

// A scalp that takes two roots through each other: their edges cross, and no other.
TEST(CrossingStep, HoldsTheRestOfHairWhoseRootsCross) {
  std::mt19937 random(17);
  Tangle tangle = randomTangle(random, 40, 0.004, false);
  const Vec3d far{0.2, 0, 0};
  for (const double side : {-1.0, 1.0}) {
    std::vector<Vec3d> points, ends;
    for (int i = 0; i < 6; ++i) {
      const Vec3d along = side < 0 ? Vec3d{0.004, 0, 0} : Vec3d{0, 0, 0.004};
      points.push_back(far + (i - 0.5) * along + Vec3d{0, side * 0.001, 0});
      ends.push_back(points.back() - Vec3d{0, side * 0.002, 0});
    }
    tangle.addStrand(points, ends, 2);
  }
  ASSERT_GT(tangle.crossings(), 1u);
  const CrossingReport report = tangle.keepApart();
  EXPECT_EQ(tangle.crossings(), 1u);
  EXPECT_EQ(report.heldSteps, 0u);
  EXPECT_EQ(report.unsafe, 0u);
}

// A particle that is nowhere crosses nothing, and holds nothing up.
TEST(CrossingStep, HoldsTheRestOfHairThatIsNotFinite) {
  std::mt19937 random(16);
  Tangle tangle = randomTangle(random, 40, 0.004, false);
  tangle.to[13].y = std::numeric_limits<double>::quiet_NaN();
  ASSERT_GT(tangle.crossings(), 0u);
  const CrossingReport report = tangle.keepApart();
  EXPECT_EQ(tangle.crossings(), 0u);
  EXPECT_EQ(std::ranges::count_if(tangle.to, [](const Vec3d& x) { return !isFinite(x); }), 1);
  EXPECT_EQ(report.heldSteps, 0u);
}

}  // namespace
}  // namespace ringlet::test::crossing_step_test
