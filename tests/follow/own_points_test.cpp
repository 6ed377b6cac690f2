// Points of hairs that keep their own shape beside their guides.
#include "ringlet/follow/own_points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <random>
#include <vector>

#include "reference/follow_guide.h"

namespace ringlet::test::own_points_test {
namespace {

using Strand = std::vector<Vec3d>;

// A curl whose points are dense at the root; a straight way has two points at least.
Strand strandOf(int particles, double length, double turns, Vec3d root, double unevenness = 0) {
  Strand strand;
  for (int i = 0; i < particles; ++i) {
    const double s = std::pow(double(i) / (particles - 1), 1 + unevenness);
    const double angle = 2 * std::numbers::pi * turns * s, r = turns > 0 ? 0.008 * std::min(1.0, 4 * s) : 0;
    strand.push_back(root + Vec3d{r * std::cos(angle) + 0.1 * s * s, -length * s, r * std::sin(angle)});
  }
  return strand;
}

struct Fixture {
  std::vector<Strand> strands;
  std::vector<GuideRest> rests;
  std::vector<RestShape> shapes;

  explicit Fixture(std::vector<Strand> all) : strands(std::move(all)) {
    for (const Strand& strand : strands) {
      rests.push_back(restOfGuide(strand));
      shapes.push_back(restShapeOf(strand, rests.back()));
    }
  }
  std::vector<reference::GuidePose> posed(Quatd head) const {
    std::vector<reference::GuidePose> poses;
    for (std::size_t g = 0; g < strands.size(); ++g) {
      Strand turned;
      for (const Vec3d& p : strands[g]) turned.push_back(rotate(head, p));
      poses.push_back(reference::poseGuide(rests[g], turned, head));
    }
    return poses;
  }
};

const Fixture& guides() {
  static const Fixture all({strandOf(64, 0.25, 6, {0, 0, 0}), strandOf(20, 0.2, 3, {0.02, 0, 0}, 0.7),
                            strandOf(33, 0.3, 0, {0, 0, 0.02}), strandOf(2, 0.1, 0, {0.02, 0, 0.02})});
  return all;
}

const std::vector<Strand>& hairs() {
  static const std::vector<Strand> all{strandOf(64, 0.25, 6, {0.004, 0, 0.003}),
                                       strandOf(97, 0.1, 9, {0.01, 0.001, 0}, 1.5),
                                       strandOf(8, 0.4, 1, {0.005, 0, 0.01}), strandOf(2, 0.2, 0, {0, 0, 0}),
                                       strandOf(5, 0.25, 0, {0.02, 0, 0.001}, 2)};
  return all;
}

FollowHair anyHair(std::mt19937& random, const Strand& strand) {
  std::uniform_real_distribution<float> unit(0, 1);
  FollowHair hair;
  hair.guide = random() % 4;
  hair.phase = 6 * unit(random) - 3;
  hair.radius = 2 * unit(random);
  hair.length = 0.2f + 0.8f * unit(random);
  hair.spread = 2 * unit(random);
  const auto offsetFrom = [&](std::uint32_t guide) {
    const RestShape& shape = guides().shapes[guide];
    return Vec3f(inFrame(shape.frames.front(), strand.front() - shape.points.front()));
  };
  hair.offset = offsetFrom(hair.guide);
  for (FollowHair::Other& other : hair.others) {
    other.guide = random() % 4;
    other.share = 0.4f * unit(random);
    other.offset = offsetFrom(other.guide);
  }
  return hair;
}

// However a hair follows, it has its own shape at rest, and where the head carries all.
TEST(OwnPoints, KeepTheShapeOfTheHair) {
  std::mt19937 random(3);
  for (const Quatd head : {Quatd{}, normalized(Quatd{0.3, -0.5, 0.2, 0.7})}) {
    const auto poses = guides().posed(head);
    for (const Strand& strand : hairs()) {
      for (int k = 0; k < 50; ++k) {
        const FollowHair hair = anyHair(random, strand);
        const auto own = ownPointsOf(hair, strand, guides().shapes);
        const auto found = reference::followGuides(hair, poses, {}, {}, std::nullopt, own);
        ASSERT_EQ(found.size(), strand.size());
        for (std::size_t i = 0; i < strand.size(); ++i)
          ASSERT_LT(length(found[i] - rotate(head, strand[i])), 1e-7) << strand.size() << " points, " << i;
      }
    }
  }
}

// A hair like its guide stands beside the same places of it, however its points are spaced.
TEST(OwnPoints, StandBesideTheSameLengthOfTheGuide) {
  for (const double unevenness : {0.0, 1.0}) {
    const Strand strand = strandOf(41, 0.3, 0, {0.01, 0, 0.02}, unevenness);
    FollowHair hair{.guide = 2};
    hair.offset =
        Vec3f(inFrame(guides().shapes[2].frames.front(), strand.front() - guides().strands[2].front()));
    const auto own = ownPointsOf(hair, strand, guides().shapes);
    for (std::size_t i = 0; i < strand.size(); ++i) {
      const Strand& guide = guides().strands[2];
      const auto along = static_cast<double>(own[i].along);
      const auto k = std::min(static_cast<std::size_t>(along), guide.size() - 2);
      const Vec3d beside = guide[k] + (guide[k + 1] - guide[k]) * (along - double(k));
      EXPECT_NEAR(beside.y, strand[i].y, 1e-4) << i;
    }
    EXPECT_EQ(own.front().along, 0);
    EXPECT_EQ(own.back().along, 32);
  }
}

// A shape of its own turns with the guide.
TEST(OwnPoints, GoAlongWithTheGuide) {
  const Strand strand = strandOf(30, 0.28, 2, {0.01, 0, 0.02});
  FollowHair hair{.guide = 2};
  hair.offset =
      Vec3f(inFrame(guides().shapes[2].frames.front(), strand.front() - guides().strands[2].front()));
  const auto own = ownPointsOf(hair, strand, guides().shapes);
  const Quatd swing = fromRotationVector(Vec3d{0.4, 0, 0.2});
  auto poses = guides().posed({});
  Strand swung;
  for (const Vec3d& p : guides().strands[2])
    swung.push_back(guides().strands[2][0] + rotate(swing, p - guides().strands[2][0]));
  poses[2] = reference::poseGuide(guides().rests[2], swung, {});
  const auto found = reference::followGuides(hair, poses, {}, {}, std::nullopt, own);
  for (std::size_t i = 8; i < strand.size(); ++i) {  // where the root's offset no longer counts
    const Vec3d wanted = guides().strands[2][0] + rotate(swing, strand[i] - guides().strands[2][0]);
    EXPECT_LT(length(found[i] - wanted), 1e-3) << i;
  }
  EXPECT_LT(length(found[0] - strand[0]), 1e-7);
}

}  // namespace
}  // namespace ringlet::test::own_points_test
