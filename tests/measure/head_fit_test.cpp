// measure/head_fit.h: the turn comes back, and where the roots leave it open the smallest that fits.
#include "ringlet/measure/head_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/measure/strand_samples.h"

namespace ringlet::head_fit_test {
namespace {

using namespace test;

// Largest distance by which two rotations move a unit axis apart.
double apart(Quatd a, Quatd b) {
  double largest = 0;
  for (Vec3d axis : {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}})
    largest = std::max(largest, length(rotate(a, axis) - rotate(b, axis)));
  return largest;
}

std::vector<Vec3d> rotatedRoots(const std::vector<Vec3d>& roots, Quatd rotation) {
  return moved(roots, rotation, {0.3, -2, 1});
}

TEST(HeadFit, FindsAnyTurnOfSpreadRoots) {
  const std::vector<Vec3d> solid{{0.1, 0, 0}, {0, 0.1, 0}, {0, 0, 0.1}, {-0.1, 0.02, 0.05}};
  const std::vector<Vec3d> flat{{0, 0, 0}, {0.1, 0, 0}, {0.03, 0, 0.08}};
  for (const auto& roots : {solid, flat}) {
    for (Vec3d axis : {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0.48, 0.6, 0.64}}) {
      for (double angle : {0.0, 1e-3, 30.0, 90.0, 179.0, 180.0, 300.0}) {
        const Quatd turn = turnAbout(axis, angle);
        EXPECT_LT(apart(fitHeadRotation(roots, rotatedRoots(roots, turn)), turn), 1e-9)
            << angle << " degrees";
      }
    }
  }
}

TEST(HeadFit, TakesTheSmallestTurnWhereRootsLeaveItOpen) {
  const Quatd turn = turnAbout({0.48, 0.6, 0.64}, 50);
  EXPECT_LT(apart(fitHeadRotation(std::vector<Vec3d>{}, std::vector<Vec3d>{}), {}), 1e-12);
  const std::vector<Vec3d> one{{1, 2, 3}};
  EXPECT_LT(apart(fitHeadRotation(one, rotatedRoots(one, turn)), {}), 1e-12);

  // On a line along X: a turn about X is not seen, one about Y is.
  const std::vector<Vec3d> line{{-0.1, 0, 0}, {0, 0, 0}, {0.2, 0, 0}};
  EXPECT_LT(apart(fitHeadRotation(line, rotatedRoots(line, turnAbout({1, 0, 0}, 40))), {}), 1e-9);
  const Quatd seen = turnAbout({0, 1, 0}, 40);
  EXPECT_LT(apart(fitHeadRotation(line, rotatedRoots(line, seen)), seen), 1e-9);
  const Quatd back = fitHeadRotation(line, rotatedRoots(line, turnAbout({0, 1, 0}, 180)));
  EXPECT_NEAR(rotate(back, Vec3d{1, 0, 0}).x, -1, 1e-9);
}

// A third of the points goes its own way: least squares would turn by it.
TEST(HeadFit, ASharedMotionIsThatOfMostPoints) {
  std::vector<Vec3d> rest, points;
  const Quatd turn = turnAbout({0.48, 0.6, 0.64}, 50);
  const Vec3d way{0.3, -2, 1};
  for (int i = 0; i < 90; ++i) {
    rest.push_back({0.2 * std::sin(1.3 * i), 0.2 * std::cos(0.7 * i), 0.1 * std::sin(2.9 * i + 1)});
    points.push_back(rotate(turn, rest.back()) + way);
    if (rest.back().x > 0.08) points.back() += Vec3d{0, 0.05, 0.2 * rest.back().x};
  }
  const HeadPose pose = fitSharedMotion(rest, points);
  EXPECT_LT(apart(pose.rotation, turn), 1e-3);
  Vec3d middle{};
  for (const Vec3d p : rest) middle += p / double(rest.size());
  EXPECT_LT(length(pose.position - rotate(turn, middle) - way), 1e-4);
  EXPECT_GT(apart(fitHeadRotation(rest, points), turn), 0.02);
  EXPECT_EQ(fitSharedMotion({}, {}).position, Vec3d{});
}

}  // namespace
}  // namespace ringlet::head_fit_test
