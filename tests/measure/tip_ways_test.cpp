// Tips in two runs, by formula: a run that turns and moves with the head goes nowhere, one that is lifted
// goes as far as it is lifted, and two that are lifted apart are as far apart. Mirrors measure/tip_ways.h.
#include "ringlet/measure/tip_ways.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "ringlet/scene/head_pose.h"

namespace ringlet::tip_ways_test {
namespace {

// Ten straight strands that stand on a plane, in centimetres.
Groom standing() {
  Groom groom;
  groom.metresPerUnit = 0.01;
  for (int s = 0; s < 10; ++s) {
    std::vector<Vec3f> strand;
    for (int i = 0; i < 5; ++i)
      strand.push_back({static_cast<float>(s % 4), static_cast<float>(i), static_cast<float>(s / 4)});
    groom.addStrand(strand);
  }
  return groom;
}

// Carried by a head there, every tip `aside` units along the head's x.
std::vector<Vec3f> carried(const Groom& groom, const Quatd& turn, Vec3d shift, double aside) {
  std::vector<Vec3f> points;
  for (std::size_t i = 0; i < groom.points.size(); ++i) {
    const bool isTip = i % 5 == 4;
    const Vec3d at = Vec3d(groom.points[i]) + Vec3d{isTip ? aside : 0, 0, 0};
    points.push_back(Vec3f(rotate(turn, at) + shift));
  }
  return points;
}

TEST(TipWays, AreSeenFromTheHead) {
  const Groom groom = standing();
  const auto ruler = GroomRuler::make(groom);
  ASSERT_TRUE(ruler) << ruler.error().message;
  const Quatd turn = fromRotationVector(Vec3d{0.3, -0.8, 1.1});
  for (const double aside : {0.0, 2.0}) {
    for (const double other : {0.0, -1.0, 3.0}) {
      const auto ways = tipWays(*ruler, groom, carried(groom, turn, {5, -7, 2}, aside),
                                carried(groom, turn, {5, -7, 2}, other));
      ASSERT_TRUE(ways) << ways.error().message;
      EXPECT_NEAR(ways->way, 0.01 * std::abs(aside), 1e-7);
      EXPECT_NEAR(ways->other, 0.01 * std::abs(other), 1e-7);
      EXPECT_NEAR(ways->apart, 0.01 * std::abs(aside - other), 1e-7);
    }
  }
}

TEST(TipWays, AreSharesOfTheOtherRuns) {
  const TipWays ways{.way = 0.03, .other = 0.04, .apart = 0.01};
  EXPECT_DOUBLE_EQ(*ways.wayShare(), 0.75);
  EXPECT_DOUBLE_EQ(*ways.apartShare(), 0.25);
  EXPECT_FALSE((TipWays{.way = 0.03, .other = 0, .apart = 0.03}.wayShare()));
}

TEST(TipWays, NameTheStrandThatIsNotFinite) {
  const Groom groom = standing();
  const auto ruler = GroomRuler::make(groom);
  ASSERT_TRUE(ruler);
  std::vector<Vec3f> lost = groom.points;
  lost[5 * 7 + 4].y = std::numeric_limits<float>::quiet_NaN();
  for (const bool first : {true, false}) {
    const auto ways = tipWays(*ruler, groom, first ? lost : groom.points, first ? groom.points : lost);
    ASSERT_FALSE(ways);
    EXPECT_NE(ways.error().message.find("strand 7"), std::string::npos) << ways.error().message;
  }
}

}  // namespace
}  // namespace ringlet::tip_ways_test
