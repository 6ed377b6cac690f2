// measure/placement_check.h: grooms and bodies in a wrong unit or place are told, and none that fit.
#include "ringlet/measure/placement_check.h"

#include <gtest/gtest.h>

#include "ringlet/bodies/icosphere.h"
#include "ringlet/bodies/mesh_grid.h"
#include "ringlet/groom/generate.h"

namespace ringlet::placement_check_test {
namespace {

Groom head() {
  HeadParameters parameters;
  parameters.strandCount = 40;
  return *makeHead(parameters);
}

Body ball(double radius) {
  Body body;
  body.name = "head";
  body.radius = radius;
  return body;
}

std::string doubtsOf(const Groom& groom, std::vector<Body> bodies, const HeadPose& at = {}) {
  std::string all;
  for (const std::string& doubt : checkPlacement(groom, bodies, at)) all += doubt + "\n";
  return all;
}

// Of the option that is advised: one that turns strands round, of a groom with a head and of one without.
TEST(PlacementCheck, NoOptionIsAdvisedThatWouldTurnNothing) {
  SwatchParameters grid;
  grid.columnCount = grid.rowCount = 5;
  Groom swatch = *makeSwatch(grid);
  std::vector<EndDistances> ends(25, {0, 0.25});
  EXPECT_FALSE(checkRootEnds(swatch, ends, "a board"));
  for (std::size_t s = 0; s < 25; s += 3) ends[s] = {0.25, 0};
  const auto some = checkRootEnds(swatch, ends, "a board");
  ASSERT_TRUE(some);
  EXPECT_NE(some->find("9 of 25 strands have their last point on a board"), std::string::npos) << *some;
  EXPECT_NE(some->find("no option tells them from the others"), std::string::npos) << *some;
  EXPECT_EQ(some->find("--root-end"), std::string::npos) << *some;
  for (EndDistances& of : ends) of = {0.25, 0};
  const auto all = checkRootEnds(swatch, ends, "a board");
  ASSERT_TRUE(all);
  EXPECT_NE(all->find("25 of 25"), std::string::npos) << *all;
  EXPECT_NE(all->find("--root-end last) turns all round"), std::string::npos) << *all;

  Groom turned = head();
  std::vector<bool> third(40);
  ends.assign(40, {0, 0.2});
  for (std::size_t s = 0; s < 40; s += 3) {
    third[s] = true;
    ends[s] = {0.2, 0};
  }
  turnRound(third, turned);
  const auto byHead = checkRootEnds(turned, ends, "the scalp");
  ASSERT_TRUE(byHead);
  EXPECT_NE(byHead->find("14 of 40"), std::string::npos) << *byHead;
  EXPECT_NE(byHead->find("--root-end head) turns those that end on the head round"), std::string::npos)
      << *byHead;
}

TEST(PlacementCheck, AHeadWithItsBodyFits) {
  const HeadPose away{{30, 1, -4}, fromRotationVector(Vec3d{0, 2, 0.5})};
  EXPECT_EQ(doubtsOf(head(), {ball(0.09)}), "");
  EXPECT_EQ(doubtsOf(head(), {ball(0.09)}, away), "") << "the head carries it";
  EXPECT_EQ(doubtsOf(head(), {}), "");
}

TEST(PlacementCheck, AWrongUnitOfTheGroom) {
  Groom groom = head();
  const double right = groom.metresPerUnit;
  groom.metresPerUnit = right / 100;
  EXPECT_NE(doubtsOf(groom, {}).find(" mm long on average; they would be "), std::string::npos);
  EXPECT_NE(doubtsOf(groom, {}).find("with --unit 0.01"), std::string::npos) << doubtsOf(groom, {});
  groom.metresPerUnit = right * 100;
  EXPECT_NE(doubtsOf(groom, {}).find(" m long on average; they would be "), std::string::npos);
  for (const double unit : {1e-5, 1e5}) {
    for (Vec3f& point : groom.points) point = point * static_cast<float>(unit);
    EXPECT_NE(doubtsOf(groom, {}).find("which no head's hair is; is the unit right"), std::string::npos);
    for (Vec3f& point : groom.points) point = point * static_cast<float>(1 / unit);
  }
}

TEST(PlacementCheck, AWrongUnitOfABody) {
  for (const double radius : {0.001, 9.0}) {
    EXPECT_NE(doubtsOf(head(), {ball(radius)}).find("the body head is"), std::string::npos) << radius;
    Body mesh;
    mesh.name = "mesh";
    mesh.shape = BodyShape::grid;
    TriangleMesh sphere = makeIcosphere(4);
    for (auto& point : sphere.points) point = point * radius;
    auto grid = makeDistanceGrid(sphere, {.cells = 16});
    ASSERT_TRUE(grid);
    mesh.grid = std::make_shared<const DistanceGrid>(std::move(grid->grid));
    EXPECT_NE(doubtsOf(head(), {mesh}).find("the body mesh is"), std::string::npos) << radius;
  }
}

TEST(PlacementCheck, AWrongPlace) {
  Body body = ball(0.09);
  body.place.position = {1.5, 0, 0};
  EXPECT_NE(doubtsOf(head(), {body}).find("no root is nearer to the body head than 1."), std::string::npos);
  body = ball(0.4);
  EXPECT_NE(doubtsOf(head(), {body}).find("half of the roots are"), std::string::npos)
      << doubtsOf(head(), {body});
}

// What has a way of its own may come from anywhere, and a floor has no size.
TEST(PlacementCheck, BodiesOfTheWorldMayBeAnywhere) {
  Body body = ball(0.001);
  body.place.position = {5, 0, 0};
  body.motion = Motion{};
  Body floor = ball(1);
  floor.shape = BodyShape::plane;
  floor.place.position = {0, -50, 0};
  EXPECT_EQ(doubtsOf(head(), {body, floor}), "");
}

}  // namespace
}  // namespace ringlet::placement_check_test
