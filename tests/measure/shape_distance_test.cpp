// measure/shape_distance.h: distances of poses against closed forms, free of unit, head and sampling.
#include "ringlet/measure/shape_distance.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/measure/strand_samples.h"
#include "tests/support/tolerances.h"

namespace ringlet::shape_distance_test {
namespace {

using namespace test;

// Of poses in metres.
std::vector<ShapeDistance> distancesOf(const Groom& rest, const Groom& pose, const Groom& other) {
  const auto ruler = GroomRuler::make(rest);
  EXPECT_TRUE(ruler) << ruler.error().message;
  const auto distances = shapeDistances(*ruler, pose.points, other.points, 1);
  EXPECT_TRUE(distances) << distances.error().message;
  return *distances;
}

// A strand alone cannot turn the head: it has one root.
ShapeDistance distanceOf(const Strand& rest, const Strand& pose, const Strand& other) {
  return distancesOf(groomOf({rest}), groomOf({pose}), groomOf({other})).front();
}

TEST(ShapeDistance, AStraightStrandSwungAboutItsRoot) {
  const Strand rest = cut({.radius = 0}, 101);
  const ShapeDistance found = distanceOf(rest, moved(rest, turnAbout({1, 0, 0}, 30), {1, 2, 3}), rest);
  // A particle at share s of the length moves by the chord 2 sin(15 degrees) s; the mean of s^2 is 1/3.
  const double chord = 2 * std::sin(15 * kPi / 180);
  EXPECT_NEAR(found.tip, chord, 1e-5);
  EXPECT_NEAR(found.particles, chord / std::sqrt(3), 1e-4);
  EXPECT_NEAR(found.core, chord / std::sqrt(3), 1e-4);
  EXPECT_NEAR(found.direction, 30, 1e-3);
  EXPECT_EQ(found.turns, 0);
  EXPECT_EQ(found.radius, 0);
}

// Winding on about the same core: particles part, the core stays.
TEST(ShapeDistance, ACurlWoundFurtherHangsWhereItHung) {
  const Helix helix, further{.turns = 8.2};
  const double arcLength = std::hypot(2 * kPi * helix.radius * helix.turns, helix.length);
  const double phase = 2 * kPi * 0.2;  // at the tip
  for (int count : {32, 64, 256}) {
    const Strand rest = cut(helix, count);
    const ShapeDistance found = distanceOf(rest, cut(further, count), rest);
    // The chord of a phase is 2 r sin(phase / 2); its square has the mean 2 r^2 (1 - sin(phase) / phase).
    EXPECT_NEAR(found.tip * arcLength, 2 * helix.radius * std::sin(phase / 2), kSampling * helix.radius);
    EXPECT_NEAR(found.particles * arcLength, helix.radius * std::sqrt(2 * (1 - std::sin(phase) / phase)),
                kSampling * helix.radius);
    EXPECT_LT(found.core * arcLength, 0.03 * helix.radius) << "the core's own error at the ends";
    EXPECT_NEAR(found.turns, 0.2 / 8, kSampling * 0.1);
    EXPECT_NEAR(found.radius, 0, kSampling);
  }
}

TEST(ShapeDistance, SignsSayWhichPoseHasMore) {
  const Strand rest = cut({}, 64), wider = cut({.radius = 0.011}, 64);
  EXPECT_NEAR(distanceOf(rest, wider, rest).radius, 0.1, kSampling);
  EXPECT_NEAR(distanceOf(rest, rest, wider).radius, -0.1, kSampling);
  // A curl that changes hand has turns too.
  const Helix helix, less{.turns = 7.6};
  EXPECT_NEAR(distanceOf(perversion(helix, 128), perversion(less, 128), perversion(helix, 128)).turns,
              -0.4 / 8, kSampling);
}

TEST(ShapeDistance, KnowsNoPlaceNoHeadAndNoUnit) {
  const Helix helix, bounced{.length = 0.27};
  std::vector<Strand> rest, pose, carried;
  const Quatd turn = turnAbout({0.48, 0.6, 0.64}, 75);
  for (Vec3d at : {Vec3d{0.05, 0, 0}, Vec3d{-0.05, 0.01, 0}, Vec3d{0, 0, 0.06}}) {
    rest.push_back(moved(cut(helix, 64), {}, at));
    pose.push_back(moved(cut(bounced, 64), {}, at));
    carried.push_back(moved(pose.back(), turn, {0.1, 0, -0.1}));
  }
  const Groom groom = groomOf(rest);
  for (const ShapeDistance& none : distancesOf(groom, groomOf(carried), groomOf(pose))) {
    EXPECT_NEAR(none.particles, 0, 1e-6);
    EXPECT_NEAR(none.core, 0, 1e-6);
    EXPECT_NEAR(none.direction, 0, 1e-3);
  }

  Groom inCentimetres = groomOf(carried), restInCentimetres = groom;
  for (Groom* scaled : {&inCentimetres, &restInCentimetres}) {
    for (Vec3f& p : scaled->points) p = p * 100.0f;
  }
  const auto ruler = GroomRuler::make(groom);
  ASSERT_TRUE(ruler);
  const auto found = shapeDistances(*ruler, inCentimetres.points, restInCentimetres.points, 0.01);
  ASSERT_TRUE(found) << found.error().message;
  const auto expected = distancesOf(groom, groomOf(pose), groom);
  for (std::size_t s = 0; s < expected.size(); ++s) {
    EXPECT_NEAR((*found)[s].tip * ruler->strand(s).arcLength(), 0.02, 1e-6);
    EXPECT_NEAR((*found)[s].particles, expected[s].particles, 1e-6);
    EXPECT_NEAR((*found)[s].turns, expected[s].turns, 1e-5);
  }
}

TEST(ShapeDistance, ErrorsNameTheStrand) {
  const Groom rest = groomOf({cut({}, 64), cut({}, 32)});
  const auto ruler = GroomRuler::make(rest);
  ASSERT_TRUE(ruler);
  Groom broken = rest;
  broken.points[64].x = std::numeric_limits<float>::quiet_NaN();
  for (const auto& refused : {shapeDistances(*ruler, broken.points, rest.points, 1),
                              shapeDistances(*ruler, rest.points, broken.points, 1)}) {
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find("strand 1: particle 0"), std::string::npos)
        << refused.error().message;
  }
}

}  // namespace
}  // namespace ringlet::shape_distance_test
