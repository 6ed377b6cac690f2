// measure/crossings.h: edges whose meeting is known, and all pairs of edges in small steps.
#include "ringlet/measure/crossings.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "ringlet/groom/groom.h"
#include "tests/rest/contact_samples.h"

namespace ringlet::crossings_test {
namespace {

using namespace test;

std::uint64_t crossings(const Groom& groom, const std::vector<Vec3f>& after) {
  return countCrossings(groom.firstPoint, groom.points, after);
}

std::vector<Vec3f> moved(std::vector<Vec3f> points, Vec3f by) {
  for (Vec3f& p : points) p += by;
  return points;
}

// One edge along X through the origin, the other along Z at a height.
Groom crossed(float height, float alongX = 0.2f) {
  Groom groom = metres();
  groom.addStrand(std::vector<Vec3f>{{-1, 0, 0}, {1, 0, 0}});
  groom.addStrand(std::vector<Vec3f>{{alongX, height, -1.1f}, {alongX, height, 0.9f}});
  return groom;
}

TEST(Crossings, OfTwoCrossedEdges) {
  EXPECT_EQ(crossings(crossed(0.3f), crossed(-0.3f).points), 1u);
  EXPECT_EQ(crossings(crossed(-0.3f), crossed(0.1f).points), 1u);
  EXPECT_EQ(crossings(crossed(0.3f), crossed(0.1f).points), 0u) << "not yet";
  EXPECT_EQ(crossings(crossed(0.3f), crossed(0.3f).points), 0u) << "still";
  EXPECT_EQ(crossings(crossed(0.3f, 1.2f), crossed(-0.3f, 1.2f).points), 0u) << "beside the edge";
  EXPECT_EQ(crossings(crossed(0.3f, 1.2f), crossed(-0.3f, 0.7f).points), 1u) << "on the edge when they meet";
  EXPECT_EQ(crossings(crossed(0.3f, 1.2f), crossed(-0.3f, 0.9f).points), 0u) << "beside it when they meet";
}

TEST(Crossings, OfOneStrandWithItselfDoNotCount) {
  Groom groom = metres();
  groom.addStrand(std::vector<Vec3f>{{-1, 0, 0}, {1, 0, 0}, {1, 1, 1}, {0.2f, 0.3f, -1}, {0.2f, 0.3f, 1}});
  std::vector<Vec3f> after = groom.points;
  after[3].y = after[4].y = -0.3f;
  EXPECT_EQ(crossings(groom, after), 0u);
}

TEST(Crossings, OfOneBundleDoNotCount) {
  const auto counted = [](std::vector<std::uint32_t> bundles) {
    const Groom before = crossed(0.3f);
    return countCrossings(before.firstPoint, before.points, crossed(-0.3f).points, bundles);
  };
  EXPECT_EQ(counted({2, 2}), 0u);
  EXPECT_EQ(counted({1, 2}), 1u);
  EXPECT_EQ(counted({0, 0}), 1u);
  EXPECT_EQ(counted({0, 2}), 1u);
}

TEST(Crossings, TwiceInAStepIsTwo) {
  // The second edge slides along Z over the first, from its one end to its other, and its ends move so that
  // over the first one's line its height is y0 + (y1 - y0) t = 8 (t - 1/4) (t - 3/4).
  const auto second = [](float t) {
    const float x = -0.5f + t, y0 = 1.5f - 4 * t, y1 = -2.5f + 4 * t;
    return std::vector<Vec3f>{{x, y0, -2 * t}, {x, y1, 2 - 2 * t}};
  };
  const std::vector<Vec3f> first{{-1, 0, 0}, {1, 0, 0}};
  const auto at = [&](float t) {
    Groom groom = metres();
    groom.addStrand(first);
    groom.addStrand(second(t));
    return groom;
  };
  EXPECT_EQ(crossings(at(0), at(1).points), 2u);
  EXPECT_EQ(crossings(at(0), at(0.5f).points), 1u);
  EXPECT_EQ(crossings(at(0.3f), at(0.7f).points), 0u);
}

TEST(Crossings, OfASheetFallingThroughASheet) {
  // 12 strands along X over 9 along Z, of many edges: each crosses each.
  Groom groom = metres();
  for (int s = 0; s < 12; ++s) groom.addStrand(line({-0.1, 0.02, 0.0071 * s}, {0.1, 0.02, 0.0071 * s}, 40));
  for (int s = 0; s < 9; ++s) groom.addStrand(line({0.0063 * s, 0, -0.03}, {0.0063 * s, 0, 0.15}, 33));
  std::vector<Vec3f> after = groom.points;
  for (std::size_t i = 0; i < 12 * 40; ++i) after[i].y -= 0.05f;
  EXPECT_EQ(crossings(groom, after), 12u * 9u);
  // All together they do not.
  EXPECT_EQ(crossings(groom, moved(groom.points, {3, -0.05f, 1})), 0u);
  // Nor do strands that slide in one plane.
  Groom plane = metres();
  for (int s = 0; s < 10; ++s) plane.addStrand(line({0.01 * s, 0, 0}, {0.01 * s, 0, 0.1}, 10));
  after = plane.points;
  for (std::size_t i = 0; i < 50; ++i) after[i].x += 0.06f;
  EXPECT_EQ(crossings(plane, after), 0u);
}

std::vector<Vec3f> between(const std::vector<Vec3f>& a, const std::vector<Vec3f>& b, double share) {
  std::vector<Vec3f> points;
  for (std::size_t i = 0; i < a.size(); ++i)
    points.push_back(
        static_cast<Vec3f>(static_cast<Vec3d>(a[i]) * (1 - share) + static_cast<Vec3d>(b[i]) * share));
  return points;
}

// Another way to see a crossing: looked at from above the first edge, in its own axes.
bool passes(const Vec3d p0[2], const Vec3d p1[2], const Vec3d q0[2], const Vec3d q1[2]) {
  // Which side of p's line q's line is on, seen along the common normal, and whether they cross in that view.
  const auto gap = [](Vec3d p, Vec3d pEnd, Vec3d q, Vec3d qEnd) {
    return dot(cross(pEnd - p, qEnd - q), q - p);
  };
  const double before = gap(p0[0], p1[0], q0[0], q1[0]), after = gap(p0[1], p1[1], q0[1], q1[1]);
  if ((before < 0) == (after < 0)) return false;
  const Vec3d a = p1[0] - p0[0], c = q1[0] - q0[0], normal = cross(a, c);
  const auto side = [&](Vec3d from, Vec3d along, Vec3d to) { return dot(cross(along, to - from), normal); };
  return side(p0[0], a, q0[0]) * side(p0[0], a, q1[0]) < 0 &&
         side(q0[0], c, p0[0]) * side(q0[0], c, p1[0]) < 0;
}

// All pairs of edges, in steps so small that nothing turns within one.
std::uint64_t byAllPairs(const Groom& groom, const std::vector<Vec3f>& after, int steps) {
  std::uint64_t count = 0;
  const auto at = [&](std::uint32_t i, double t) {
    return static_cast<Vec3d>(groom.points[i]) * (1 - t) + static_cast<Vec3d>(after[i]) * t;
  };
  for (std::size_t s = 0; s < groom.strandCount(); ++s) {
    for (std::size_t r = s + 1; r < groom.strandCount(); ++r) {
      for (std::uint32_t i = groom.firstPoint[s]; i + 1 < groom.firstPoint[s + 1]; ++i) {
        for (std::uint32_t j = groom.firstPoint[r]; j + 1 < groom.firstPoint[r + 1]; ++j) {
          for (int k = 0; k < steps; ++k) {
            const double t0 = double(k) / steps, t1 = double(k + 1) / steps;
            const Vec3d p0[2] = {at(i, t0), at(i, t1)}, p1[2] = {at(i + 1, t0), at(i + 1, t1)};
            const Vec3d q0[2] = {at(j, t0), at(j, t1)}, q1[2] = {at(j + 1, t0), at(j + 1, t1)};
            count += passes(p0, p1, q0, q1);
          }
        }
      }
    }
  }
  return count;
}

TEST(Crossings, AreThoseOfAllPairsInSmallSteps) {
  std::uint64_t all = 0;
  for (unsigned seed = 60; seed < 80; ++seed) {
    Groom groom = metres(), later = metres();
    addWandering(groom, 8, 8, {}, {0.01, 0.01, 0.01}, 0.01, seed);
    later = groom;
    std::mt19937 random(seed);
    std::normal_distribution<float> noise(0, 0.01f);
    for (Vec3f& p : later.points) p += Vec3f{noise(random), noise(random), noise(random)};
    const std::uint64_t found = crossings(groom, later.points);
    EXPECT_EQ(found, byAllPairs(groom, later.points, 2000)) << "seed " << seed;
    all += found;
  }
  EXPECT_GT(all, 100u);
}

TEST(Crossings, AddUpOverSteps) {
  for (const ContactSample& sample : contactSamples()) {
    std::mt19937 random(81);
    std::normal_distribution<float> noise(0, 0.01f);
    const auto moved = [&](std::vector<Vec3f> points) {
      for (Vec3f& p : points) p += Vec3f{noise(random), noise(random), noise(random)};
      return points;
    };
    const auto before = moved(sample.groom.points), after = moved(sample.groom.points);
    const auto count = [&](const std::vector<Vec3f>& from, const std::vector<Vec3f>& to) {
      return countCrossings(sample.groom.firstPoint, from, to);
    };
    const std::uint64_t whole = count(before, after);
    std::uint64_t sum = 0;
    std::vector<Vec3f> now = before;
    for (int k = 1; k <= 4; ++k) {
      const auto next = between(before, after, k / 4.0);
      sum += count(now, next);
      now = next;
    }
    // On the way positions are rounded to floats: another path, if only by little.
    EXPECT_NEAR(static_cast<double>(sum), static_cast<double>(whole), 0.01 * static_cast<double>(whole))
        << sample.name;
    EXPECT_EQ(count(before, after), whole) << sample.name;
    EXPECT_EQ(count(after, before), whole) << sample.name << ": back on the same path";
  }
}

TEST(Crossings, AStepThatEndsInContactLosesNone) {
  // Exactly in one plane between two steps: the crossing is in one of them.
  for (float end : {0.3f, -0.3f}) {
    const std::uint64_t down = crossings(crossed(end), crossed(0).points);
    const std::uint64_t on = crossings(crossed(0), crossed(-end).points);
    EXPECT_EQ(down + on, 1u);
    EXPECT_EQ(down + crossings(crossed(0), crossed(end).points), 2 * down)
        << "touched, and back: none, or in and out";
  }
}

// A strand that passes exactly where two edges of another meet passes one of them, whichever side it is on.
TEST(Crossings, AtAJointOfEdgesIsOne) {
  for (bool jointedFirst : {true, false}) {
    for (float from : {0.5f, -0.5f}) {
      const auto at = [&](float height) {
        const std::vector<Vec3f> jointed{{-1, 0, 0}, {0, 0, 0}, {1, 0, 0}},
            passing{{0, height, -1}, {0, height, 1}};
        Groom groom = metres();
        groom.addStrand(jointedFirst ? jointed : passing);
        groom.addStrand(jointedFirst ? passing : jointed);
        return groom;
      };
      EXPECT_EQ(crossings(at(from), at(-from).points), 1u) << jointedFirst << " from " << from;
    }
  }
}

// Two edges lie exactly in one plane where a step ends and the next begins, on a path whose numbers are
// rounded. Each passes the other once, so that both steps together count one crossing. The steps count
// none or two where the volume at the end of the first has another sign than at the start of the second.
TEST(Crossings, ATouchBetweenTwoStepsCountsOnce) {
  std::mt19937 random(17);
  std::uniform_real_distribution<float> about(-0.1f, 0.1f), height(0.1f, 1);
  for (int i = 0; i < 2000; ++i) {
    const float plane = about(random), from = i % 2 == 0 ? height(random) : -height(random), to = -from;
    const auto at = [&](float above) {
      return std::vector<Vec3f>{{-1 + about(random), plane, about(random)},
                                {1 + about(random), plane, about(random)},
                                {about(random), plane + above, -1 + about(random)},
                                {about(random), plane + above, 1 + about(random)}};
    };
    const std::vector<std::uint32_t> firstPoint{0, 2, 4};
    const auto before = at(from), touching = at(0), after = at(to);
    ASSERT_EQ(countCrossings(firstPoint, before, touching) + countCrossings(firstPoint, touching, after), 1u)
        << "pair " << i;
  }
}

TEST(Crossings, WhatIsNotFiniteCrossesNothing) {
  for (float lost : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    auto after = crossed(-0.3f).points;
    after[3].x = lost;
    EXPECT_EQ(crossings(crossed(0.3f), after), 0u);
    EXPECT_EQ(countCrossings(crossed(0.3f).firstPoint, after, crossed(0.3f).points), 0u);
  }
}

}  // namespace
}  // namespace ringlet::crossings_test
