// Tests measure/body_watch.h and bodies/body_distance.h.
#include "ringlet/measure/body_watch.h"

#include <gtest/gtest.h>

#include <random>

#include "ringlet/bodies/body_distance.h"
#include "ringlet/bodies/make_bending_mesh.h"
#include "ringlet/bodies/triangle_tree.h"
#include "tests/bodies/body_samples.h"
#include "tests/support/sample_bodies.h"

namespace ringlet::test::body_watch_test {
namespace {

void expectSame(const BodyNumbers& seen, const BodyNumbers& expected) {
  EXPECT_EQ(seen.deepest, expected.deepest);
  EXPECT_EQ(seen.strand, expected.strand);
  EXPECT_EQ(seen.particle, expected.particle);
  EXPECT_EQ(seen.frame, expected.frame);
  EXPECT_EQ(seen.inside, expected.inside);
}

TEST(BodyDistance, OfEveryShape) {
  const auto bodies = sampleBodies();
  EXPECT_NEAR(distanceTo(bodies[0], {0.3, 0, 0.4}), 0.4, 1e-15);
  EXPECT_NEAR(distanceTo(bodies[1], {0, 0.25, 0}), 0.1, 1e-15);
  EXPECT_NEAR(distanceTo(bodies[1], {0.02, 0.05, 0}), -0.03, 1e-15);
  EXPECT_NEAR(distanceTo(bodies[2], {9, -0.25, 4}), -0.26, 1e-15);   // 1 cm kept away
  EXPECT_NEAR(distanceTo(bodies[3], {0.11, 0.14, 0}), 0.04, 1e-15);  // 3, 4, 5 less 1 cm kept away
  EXPECT_NEAR(distanceTo(bodies[3], {0, 0, 0.05}), -0.02, 1e-15);
  EXPECT_NEAR(distanceTo(bodies[4], {0.05, 0.05, 0.05}), 0.05 * std::sqrt(3.0) - 0.1, 1e-4);
  // With a pose: turned and moved.
  const BodyPose pose{{1, 2, 3}, fromRotationVector(Vec3d{0, 0, 1.5707963267948966})};
  EXPECT_NEAR(distanceTo(bodies[2], pose, {0.5, 0, 0}), 0.49, 1e-12);  // its Y points along -X
}

TEST(BodyWatch, CountsWhatWasOutside) {
  Groom groom;
  groom.metresPerUnit = 1;
  groom.addStrand(std::vector<Vec3f>{{0, 0, 0}, {0, 0, 0}, {1, 0, 0}, {2, 0, 0}});
  const std::vector<Body> bodies{{.radius = 0.1}};
  const std::vector<BodyPose> poses{{{5, 0, 0}, {}}};
  BodyWatch watch(groom, bodies, 1);
  const HeadPose head{{5, 0, 0}, {}};
  watch.look(groom.points, head,
             poses);  // particle 1 is in the middle: it began there; the root does not count
  EXPECT_EQ(watch.numbers().deepest, 0);
  EXPECT_EQ(watch.numbers().inside, 1u);
  watch.look(std::vector<Vec3f>{{0, 0, 0}, {0.5f, 0, 0}, {0.07f, 0, 0}, {2, 0, 0}}, head, poses);
  EXPECT_NEAR(watch.numbers().deepest, 0.03, 1e-8);
  EXPECT_EQ(watch.numbers().particle, 2);
  EXPECT_EQ(watch.numbers().frame, 1);
  EXPECT_EQ(watch.numbers().inside, 0u);
  watch.look(std::vector<Vec3f>{{0, 0, 0}, {0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, head, poses);
  EXPECT_NEAR(watch.numbers().deepest, 0.1, 1e-12);
  EXPECT_EQ(watch.numbers().particle, 1);
}

// Of each body, and for good; what is no deeper than it keeps hair out is not.
TEST(BodyWatch, CountsWhatIsCaught) {
  Groom groom;
  groom.metresPerUnit = 1;
  groom.addStrand(std::vector<Vec3f>{{0, 9, 0}, {1, 0, 0}, {1, 0, 0}, {1, 0, 0}});
  Body bending{.shape = BodyShape::grid};
  auto mesh = std::make_shared<BendingMesh>();
  mesh->cell = 0.004;
  bending.mesh = mesh;
  EXPECT_NEAR(keepsOutWithin(bending), 0.0021, 1e-12);
  Body rigid{.shape = BodyShape::grid};
  auto grid = std::make_shared<DistanceGrid>();
  grid->cell = 0.002;
  rigid.grid = grid;
  EXPECT_NEAR(keepsOutWithin(rigid), 0.0011, 1e-12);
  const std::vector<Body> bodies{{.radius = 0.1}, {.radius = 0.2}};
  EXPECT_NEAR(keepsOutWithin(bodies[0]), 1e-4, 1e-12);
  const std::vector<BodyPose> poses{{{0, 0, 0}, {}}, {{3, 0, 0}, {}}};
  BodyWatch watch(groom, bodies, 1);
  const auto look = [&](float a, float b, float c) {
    watch.look(std::vector<Vec3f>{{0, 9, 0}, {a, 0, 0}, {b, 0, 0}, {c, 0, 0}}, HeadPose{}, poses);
  };
  look(0, 1, 1);
  look(0.0999f, 0.09995f, 1);  // the first began there, and the second is hardly in it
  EXPECT_EQ(watch.numbers().caught, 0u);
  look(1, 0.099f, 3.1f);
  EXPECT_EQ(watch.numbersOf(0).caught, 1u);
  EXPECT_EQ(watch.numbersOf(1).caught, 1u);
  EXPECT_NEAR(watch.numbersOf(1).deepest, 0.1, 1e-6);
  EXPECT_EQ(watch.numbersOf(1).particle, 3);
  EXPECT_NEAR(watch.numbersOf(0).deepest, 0.001, 1e-6);
  look(1, 1, 1);
  look(0.05f, 0.099f, 1);
  EXPECT_EQ(watch.numbers().caught, 3u);
  EXPECT_EQ(watch.numbers().inside, 0u);
  EXPECT_EQ(watch.numbers().particle, 3);
}

// The rounding of positions, or of a grid, puts hair that lies on a surface a little below it.
TEST(BodyWatch, HairThatLiesOnABodyIsNotInside) {
  Groom groom;
  groom.metresPerUnit = 1;
  groom.addStrand(std::vector<Vec3f>{{0, 0, 0}, {0.2f, 0, 0}, {0.2f, 0, 0}, {0.2f, 0, 0}});
  const std::vector<Body> bodies{{.radius = 0.1}};
  const std::vector<BodyPose> poses{{{0, 0, 0}, {}}};
  const auto insideAt = [&](std::vector<std::vector<float>> looks) {
    BodyWatch watch(groom, bodies, 1);
    for (const auto& x : looks)
      watch.look(std::vector<Vec3f>{{0, 0, 0}, {x[0], 0, 0}, {x[1], 0, 0}, {x[2], 0, 0}}, HeadPose{}, poses);
    EXPECT_EQ(watch.numbers().deepest, 0) << "none was outside";
    return watch.numbers().inside;
  };
  EXPECT_EQ(insideAt({{0.099999f, 0.099995f, 0.0999f}}), 1u) << "1 and 5 um are rounding, 0.1 mm is not";
  EXPECT_EQ(insideAt({{0.09f, 0.09f, 0.09f}, {0.099999f, 0.095f, 0.09f}}), 2u)
      << "one was pushed to the surface";
  EXPECT_EQ(insideAt({{0.099999f, 0.09f, 0.09f}, {0.0999f, 0.09f, 0.09f}}), 2u)
      << "and stays counted as that";
}

// Against a look at every particle by itself, in all shapes, along strands that wander out of bodies and in.
TEST(BodyWatch, LeavesOutNothingThatIsInside) {
  constexpr int kStrands = 200, kParticles = 12, kLooks = 4;
  const auto bodies = sampleBodies();
  const std::vector<BodyPose> poses(bodies.size(), BodyPose{{0.02, 0, 0}, {}});
  std::mt19937 random(1);
  std::normal_distribution<float> step(0, 0.02f);
  std::vector<Groom> looks(kLooks);
  for (Groom& groom : looks) {
    groom.metresPerUnit = 1;
    for (int s = 0; s < kStrands; ++s) {
      std::vector<Vec3f> points{{0.2f, 0.1f * float(s % 5), 0}};
      while (points.size() < kParticles)
        points.push_back(points.back() + Vec3f{step(random), step(random), step(random)});
      groom.addStrand(points);
    }
  }
  BodyWatch watch(looks[0], bodies, 1);
  BodyNumbers expected;
  std::vector<bool> wasOutside(bodies.size() * kStrands * kParticles, false);
  for (int look = 0; look < kLooks; ++look) {
    const std::vector<Vec3f>& points = looks[std::size_t(look)].points;
    watch.look(points, HeadPose{}, poses);
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      for (std::size_t i = 0; i < points.size(); ++i) {
        if (i % kParticles == 0) continue;
        const double distance = distanceTo(bodies[b], poses[b], Vec3d(points[i]));
        const std::size_t place = b * points.size() + i;
        if (distance >= 0) wasOutside[place] = true;
        if (!wasOutside[place] || -distance <= expected.deepest) continue;
        expected = {-distance, std::int64_t(i / kParticles), std::int64_t(i % kParticles), look, 0};
      }
    }
  }
  for (std::size_t place = 0; place < wasOutside.size(); ++place)
    expected.inside += place % kParticles != 0 && !wasOutside[place] ? 1 : 0;
  EXPECT_GT(expected.deepest, 0.05);
  EXPECT_GT(expected.inside, 10u);
  expectSame(watch.numbers(), expected);
}

// A ball that bends: as it was at first, then where its points are, by its triangles and not by a grid.
TEST(BodyWatch, SeesWhereABodyBendsTo) {
  const TriangleMesh ball = sphereMesh(0.1, 12);
  std::vector<std::string> warnings;
  std::vector<Body> bodies{{.radius = 0.01}, {.name = "ball", .shape = BodyShape::grid}};
  ASSERT_TRUE(makeBendingMesh(ball, bendingRoomOf(ball.points, {}, 16), bodies[1], warnings));
  Groom groom;
  groom.metresPerUnit = 1;
  groom.addStrand(std::vector<Vec3f>{{0, 0, 0}, {0.2f, 0, 0}, {0, 0.3f, 0}, {0, 0, 0.05f}});
  const std::vector<BodyPose> poses{{{9, 0, 0}, {}}, {{1, 0, 0}, {}}};
  const HeadPose head{{1, 0, 0}, {}};
  BodyWatch watch(groom, bodies, 1);
  watch.look(groom.points, head, poses);
  EXPECT_EQ(watch.numbers().deepest, 0);
  EXPECT_EQ(watch.numbers().inside, 1u);  // the last
  std::vector<Vec3d> twice;
  for (const Vec3d& p : ball.points) twice.push_back(p * 2.5 + Vec3d{1, 0, 0});
  const std::span<const Vec3d> points(twice);
  watch.look(groom.points, head, poses, std::span(&points, 1));
  EXPECT_NEAR(watch.numbers().deepest, 0.05, 0.002);
  EXPECT_EQ(watch.numbers().particle, 1);
  EXPECT_EQ(watch.numbers().frame, 1);
}

// Against a look at every particle by itself, along strands that wander out of a ball and in while it swells
// and is thick. Some strands begin inside.
TEST(BodyWatch, LeavesOutNothingThatIsInsideWhatBends) {
  constexpr int kStrands = 300, kParticles = 16, kLooks = 4;
  constexpr double kThickness = 0.012, kOnSurface = 1e-5;  // [m]
  const TriangleMesh ball = sphereMesh(0.1, 12);
  std::vector<std::string> warnings;
  std::vector<Body> bodies{{.name = "ball", .shape = BodyShape::grid, .thickness = kThickness}};
  ASSERT_TRUE(makeBendingMesh(ball, bendingRoomOf(ball.points, {}, 16), bodies[0], warnings));
  std::mt19937 random(2);
  std::normal_distribution<float> step(0, 0.006f);
  std::uniform_real_distribution<float> side(-0.13f, 0.13f);
  Groom groom;
  groom.metresPerUnit = 1;
  for (int s = 0; s < kStrands; ++s) {
    std::vector<Vec3f> points{{side(random), side(random), side(random)}};
    while (points.size() < kParticles)
      points.push_back(points.back() + Vec3f{step(random), step(random), step(random)});
    groom.addStrand(points);
  }
  BodyWatch watch(groom, bodies, 1);
  BodyNumbers expected;
  std::vector<bool> wasOutside(groom.points.size(), false), wasOnIt = wasOutside;
  for (int look = 0; look < kLooks; ++look) {
    std::vector<Vec3d> swollen;
    for (const Vec3d& p : ball.points)
      swollen.push_back({p.x * (1 + 0.1 * look), p.y, p.z * (1 - 0.05 * look)});
    const std::span<const Vec3d> ends(swollen);
    watch.look(groom.points, HeadPose{}, std::vector<BodyPose>(1), std::span(&ends, 1));
    const TriangleTree tree({swollen, ball.triangles});
    for (std::size_t i = 0; i < groom.points.size(); ++i) {
      if (i % kParticles == 0) continue;
      const Vec3d place(groom.points[i]);
      const double apart = tree.nearest(place).distance;
      const double distance = (tree.windingNumber(place) > 0.5 ? -apart : apart) - kThickness;
      if (distance >= 0) wasOutside[i] = true;
      if (distance >= -kOnSurface) wasOnIt[i] = true;
      if (!wasOutside[i] || -distance <= expected.deepest) continue;
      expected = {-distance, std::int64_t(i / kParticles), std::int64_t(i % kParticles), look, 0};
    }
  }
  for (std::size_t i = 0; i < wasOnIt.size(); ++i)
    expected.inside += i % kParticles != 0 && !wasOnIt[i] ? 1 : 0;
  EXPECT_GT(expected.deepest, 0.02);
  EXPECT_GT(expected.inside, 100u);
  expectSame(watch.numbers(), expected);
}

}  // namespace
}  // namespace ringlet::test::body_watch_test
