// Tests crossings/crossing_judge.h: pairs whose crossing is known, and a million random ones against
// the exact count.
#include "ringlet/crossings/crossing_judge.h"

#include <gtest/gtest.h>

#include "tests/kernels/crossing_samples.h"

namespace ringlet::test::crossing_judge_test {
namespace {

constexpr PairDemand kDemand{1e-4, 1e-5};  // [m]

PairVerdict judged(const MovedPair& pair, const PairDemand& demand = kDemand) {
  return judgePair(pair.p, pair.q, demand);
}

// An edge along X through the origin; another along Z at a height, going to another.
MovedPair crossed(double height, double heightAfter) {
  const EdgeEnds p{Vec3d{-0.01, 0, 0}, Vec3d{0.01, 0, 0}};
  const auto q = [](double y) { return EdgeEnds{Vec3d{0.002, y, -0.01}, Vec3d{0.002, y, 0.008}}; };
  return {{p, p}, {q(height), q(heightAfter)}};
}

TEST(CrossingJudge, NearestPointsOfEdges) {
  const MovedPair pair = crossed(0.003, 0);
  const NearestOfEdges near = nearestOfEdges(pair.p.from, pair.q.from);
  EXPECT_NEAR(near.gap, 0.003, 1e-15);
  EXPECT_NEAR(near.onP, 0.6, 1e-12);
  EXPECT_NEAR(near.onQ, 10.0 / 18, 1e-12);
  EXPECT_LT(length(near.normal - Vec3d{0, -1, 0}), 1e-12);
  std::mt19937 random(2);
  for (int trial = 0; trial < 2000; ++trial) {
    const MovedPair one = randomPair(random);
    const NearestOfEdges at = nearestOfEdges(one.p.from, one.q.from);
    double nearest = 1;
    for (int i = 0; i <= 40; ++i)
      for (int j = 0; j <= 40; ++j) {
        const Vec3d x = one.p.from[0] + i / 40.0 * (one.p.from[1] - one.p.from[0]);
        const Vec3d y = one.q.from[0] + j / 40.0 * (one.q.from[1] - one.q.from[0]);
        nearest = std::min(nearest, length(x - y));
      }
    ASSERT_LE(at.gap, nearest + 1e-6) << trial;  // of nearly parallel ones
    ASSERT_GE(at.gap, nearest - 5e-4) << trial;
  }
}

TEST(CrossingJudge, SeesAnEdgeThatGoesThroughAnother) {
  EXPECT_FALSE(judged(crossed(0.003, -0.003)).isSafe);
  EXPECT_TRUE(judged(crossed(0.003, 0.001)).isSafe);
  EXPECT_EQ(judged(crossed(0.003, 0.001)).shortfall, 0);
  // Nearer than it aims at, but on its side.
  const PairVerdict near = judged(crossed(0.003, 3e-5));
  EXPECT_TRUE(near.isSafe);
  EXPECT_NEAR(near.shortfall, 7e-5, 1e-12);
  EXPECT_FALSE(judged(crossed(0.003, 5e-6)).isSafe) << "nearer than any may end";
}

TEST(CrossingJudge, PushesByWhatThePairLacks) {
  MovedPair pair = crossed(0.003, -0.002);
  const PairVerdict verdict = judged(pair);
  EXPECT_NEAR(verdict.shortfall, 0.0021, 1e-12);
  for (Vec3d& end : pair.p.to) end += verdict.shortfall * verdict.at.normal;
  EXPECT_TRUE(judged(pair).isSafe);
}

// Pairs that an affine map moves never cross, however near they are: a turn by half a radian.
TEST(CrossingJudge, LetsPairsTurnTogether) {
  std::mt19937 random(4);
  const Quatd turn = fromRotationVector(Vec3d{1, 2, 2} * (0.5 / 3));
  int safe = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    MovedPair pair = randomPair(random);
    for (EdgeWay* edge : {&pair.p, &pair.q})
      for (std::size_t e = 0; e < 2; ++e) edge->to[e] = rotate(turn, edge->from[e]) + Vec3d{0.01, 0, 0};
    const double apart = nearestOfEdges(pair.p.from, pair.q.from).gap;
    ASSERT_EQ(exactCrossings(pair), 0u);
    safe += judged(pair, demandOf(apart, 1e-4, 1e-5)).isSafe;
  }
  EXPECT_GT(safe, 1980);
}

// The promise itself.
TEST(CrossingJudge, NoPairThatCrossesCountsAsSafe) {
  std::mt19937 random(5);
  int safe = 0, crossing = 0, bothNot = 0, missedByEnds = 0;
  for (int trial = 0; trial < 1'000'000; ++trial) {
    const MovedPair pair = randomPair(random);
    const double apart = nearestOfEdges(pair.p.from, pair.q.from).gap;
    const bool isSafe = judged(pair, demandOf(apart, 1e-4, 1e-5)).isSafe;
    const bool crosses = exactCrossings(pair) > 0;
    ASSERT_FALSE(isSafe && crosses) << trial;
    safe += isSafe, crossing += crosses, bothNot += !isSafe && !crosses;
    missedByEnds += crosses && nearestOfEdges(pair.p.to, pair.q.to).gap > 1e-5;
  }
  EXPECT_GT(safe, 300'000);
  EXPECT_GT(crossing, 50'000);
  EXPECT_GT(missedByEnds, 40'000) << "who looks at the end alone sees few";
  EXPECT_LT(bothNot, 200'000) << "what is neither known to be safe nor crosses";
}

}  // namespace
}  // namespace ringlet::test::crossing_judge_test
