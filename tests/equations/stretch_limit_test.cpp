// Tests reference/equations/stretch_limit.h.
#include "reference/equations/stretch_limit.h"

#include <gtest/gtest.h>

#include "tests/equations/strand_fixtures.h"

namespace ringlet::reference::test::stretch_limit_test {
namespace {

struct Limited {
  Field<double> before, positions, velocities;
  Scalars<double> lengths;
  std::size_t count = 0;
};

// A random polyline, edges between 0.4 and 1.6 or so of the groom's.
Limited limitRandom(std::size_t rootCount, double maxStretch, double T) {
  std::mt19937 random(7);
  Limited result;
  result.before = {Vector3<double>::Zero()};
  for (int i = 0; i < 80; ++i) {
    result.lengths.push_back(0.004);
    const double stretch = 1 + randomVector(random, 0.6).x();
    result.before.push_back(result.before.back() + 0.004 * stretch * randomVector(random, 1).normalized());
  }
  result.positions = result.before;
  result.velocities.assign(result.before.size(), Vector3<double>(1, 2, 3));
  Field<double> edges;
  for (std::size_t i = 0; i + 1 < result.before.size(); ++i)
    edges.push_back(result.before[i + 1] - result.before[i]);
  result.count =
      limitStretch(rootCount, maxStretch, T, result.lengths, edges, result.positions, result.velocities);
  return result;
}

TEST(StretchLimit, ShortensLongEdgesAndLeavesShortOnes) {
  const double maxStretch = 1.1, T = 0.005;
  for (const std::size_t rootCount : {1u, 3u}) {
    const Limited result = limitRandom(rootCount, maxStretch, T);
    std::size_t tooLong = 0;
    for (std::size_t i = 0; i < result.lengths.size(); ++i) {
      const Vector3<double> before = result.before[i + 1] - result.before[i];
      const Vector3<double> after = result.positions[i + 1] - result.positions[i];
      const double limit = maxStretch * result.lengths[i];
      const bool isLimited = i + 1 >= rootCount && before.norm() > limit;
      tooLong += isLimited ? 1 : 0;
      // Direction kept; length the limit's or its own.
      const Vector3<double> expected = isLimited ? Vector3<double>(before * (limit / before.norm())) : before;
      EXPECT_LT((after - expected).norm(), 1e-15) << i;
    }
    EXPECT_EQ(result.count, tooLong);
    EXPECT_GT(tooLong, 10u);
    for (std::size_t i = 0; i < rootCount; ++i) EXPECT_EQ(result.positions[i], result.before[i]);
    // Velocities follow the positions.
    for (std::size_t i = 0; i < result.before.size(); ++i) {
      const Vector3<double> expected =
          Vector3<double>(1, 2, 3) + (result.positions[i] - result.before[i]) / T;
      EXPECT_LT((result.velocities[i] - expected).norm(), 1e-12);
    }
  }
}

TEST(StretchLimit, ARigidStrandIsLeftAlone) {
  Field<double> positions{{0, 0, 0}, {9, 0, 0}}, velocities(2, Vector3<double>::Zero());
  EXPECT_EQ(limitStretch(2, 1.1, 0.005, Scalars<double>{1.0}, {{9, 0, 0}}, positions, velocities), 0u);
  EXPECT_EQ(positions[1], Vector3<double>(9, 0, 0));
}

// Edges at 1.05 of the groom's, limit 1.1: over T = 0.01 s they may lengthen by 0.05 l, at 5 l per second.
TEST(StretchLimit, RatesAreLimitedRootToTip) {
  const Field<double> edges(3, Vector3<double>(1.05, 0, 0)), directions(3, Vector3<double>::UnitX());
  Field<double> velocities{{0, 0, 0}, {7, 1, 0}, {6, 2, 0}, {20, 3, 0}};
  limitRates(1, 1.1, 0.01, Scalars<double>(3, 1.0), edges, directions, velocities);
  // Rates 7, -1, 14 become 5, -1, 5; motion across the edges is untouched.
  const Field<double> expected{{0, 0, 0}, {5, 1, 0}, {4, 2, 0}, {9, 3, 0}};
  EXPECT_LT(maxDistance(velocities, expected), 1e-12);
}

TEST(StretchLimit, AnEdgeBeyondTheLimitMayNotLengthen) {
  const Field<double> edges(1, Vector3<double>(1.2, 0, 0)), directions(1, Vector3<double>::UnitX());
  Field<double> velocities{{0, 0, 0}, {1, 0, 0}};
  limitRates(1, 1.1, 0.01, Scalars<double>(1, 1.0), edges, directions, velocities);
  EXPECT_EQ(velocities[1], Vector3<double>::Zero());
}

}  // namespace
}  // namespace ringlet::reference::test::stretch_limit_test
