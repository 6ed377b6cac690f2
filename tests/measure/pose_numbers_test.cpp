// measure/pose_numbers.h: against closed forms, and against the measures of strands.
#include "ringlet/measure/pose_numbers.h"

#include <gtest/gtest.h>

#include <cmath>

#include "ringlet/groom/generate.h"
#include "ringlet/measure/groom_measure.h"

namespace ringlet::pose_numbers_test {
namespace {

Groom twoStrands() {
  Groom groom;
  groom.metresPerUnit = 0.01;
  groom.addStrand(std::vector<Vec3f>{{0, 0, 0}, {10, 0, 0}, {20, 0, 0}});
  groom.addStrand(std::vector<Vec3f>{{0, 0, 5}, {0, -10, 5}});
  return groom;
}

TEST(PoseNumbers, OfALoweredTipAndALongerEdge) {
  const Groom rest = twoStrands();
  std::vector<Vec3f> points = rest.points;
  points[2] = {10, -12, 0};  // 12 cm below, the edge 12 in place of 10 long
  const PoseNumbers numbers = poseNumbers(rest, points, {0, 1, 0}, {});
  EXPECT_NEAR(numbers.droop, 0.12 / 2, 1e-7);
  EXPECT_NEAR(numbers.maxStretch, 1.2, 1e-6);
  EXPECT_NEAR(numbers.meanStretch, 32.0 / 30, 1e-6);
}

// About Z by 90 degrees: the first strand then stands at rest, the second lies.
TEST(PoseNumbers, AHeadThatTurnsIsNoDroop) {
  const Groom rest = twoStrands();
  const Quatd turned{0, 0, std::sqrt(0.5), std::sqrt(0.5)};
  std::vector<Vec3f> points;
  for (const Vec3f& p : rest.points) points.push_back(Vec3f(rotate(turned, Vec3d(p)) + Vec3d{1, 2, 3}));
  const PoseNumbers numbers = poseNumbers(rest, points, {0, 1, 0}, turned);
  EXPECT_NEAR(numbers.droop, 0, 1e-7);
  EXPECT_NEAR(numbers.meanStretch, 1, 1e-6);
  EXPECT_NEAR(poseNumbers(rest, points, {0, 0, 1}, {}).droop, 0, 1e-7);
}

TEST(PoseNumbers, DroopIsThatOfMeasuredStrands) {
  const Groom rest = *makeSwatch({.columnCount = 3, .rowCount = 2});
  std::vector<Vec3f> points = rest.points;
  for (std::size_t i = 0; i < points.size(); ++i) points[i].y *= 1.0f + 0.001f * static_cast<float>(i % 7);
  const auto ruler = GroomRuler::make(rest);
  ASSERT_TRUE(ruler);
  const auto measures = ruler->measure(points, rest.metresPerUnit, {0, 1, 0});
  ASSERT_TRUE(measures);
  EXPECT_NEAR(poseNumbers(rest, points, {0, 1, 0}, {}).droop, ruler->summarize(*measures).droop.mean, 1e-9);
}

TEST(PoseNumbers, EdgesWithoutLengthDoNotCount) {
  Groom rest;
  rest.addStrand(std::vector<Vec3f>{{0, 0, 0}, {0, 0, 0}, {0, -1, 0}});
  const PoseNumbers numbers = poseNumbers(rest, rest.points, {0, 1, 0}, {});
  EXPECT_EQ(numbers.maxStretch, 1);
  EXPECT_EQ(numbers.meanStretch, 1);
}

}  // namespace
}  // namespace ringlet::pose_numbers_test
