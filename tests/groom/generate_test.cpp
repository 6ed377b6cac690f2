// groom/generate.h: curls against their formula, heads against what a head of hair must be.
#include "ringlet/groom/generate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include "ringlet/groom/curl_shape.h"
#include "ringlet/groom/hair_styles.h"
#include "ringlet/groom/head_regions.h"
#include "ringlet/groom/seeded_random.h"
#include "tests/groom/groom_samples.h"
#include "tests/groom/style_samples.h"

namespace ringlet::generate_test {
namespace {

constexpr double kPi = std::numbers::pi;

std::vector<Vec3d> metresOf(const Groom& groom, std::size_t s) {
  std::vector<Vec3d> strand;
  for (Vec3f p : groom.strand(s)) strand.push_back(Vec3d(p) * groom.metresPerUnit);
  return strand;
}

void expectError(const Result<Groom>& groom, const std::string& part) {
  ASSERT_FALSE(groom) << part;
  EXPECT_TRUE(test::contains(groom.error().message, part)) << groom.error().message;
}

TEST(MakeCurl, IsTheHelixOfTheFormula) {
  for (int handedness : {1, -1}) {
    const CurlParameters p{.radius = 0.02,
                           .turns = 5,
                           .length = 0.3,
                           .particleCount = 77,
                           .handedness = handedness,
                           .phase = 0.4,
                           .metresPerUnit = 0.01};
    const Result<Groom> groom = makeCurl(p);
    ASSERT_TRUE(groom) << groom.error().message;
    ASSERT_EQ(groom->strandCount(), 1u);
    ASSERT_EQ(groom->points.size(), 77u);
    EXPECT_EQ(groom->metresPerUnit, 0.01);
    for (std::size_t i = 0; i < 77; ++i) {
      const double s = double(i) / 76, angle = 0.4 + handedness * 2 * kPi * 5 * s;
      const Vec3d expected = Vec3d{0.02 * std::cos(angle), -0.3 * s, 0.02 * std::sin(angle)} * 100.0;
      EXPECT_LT(length(Vec3d(groom->points[i]) - expected), 4e-6) << "particle " << i;  // [cm], float at 30
    }
  }
}

TEST(MakeCurl, DefaultsAreTheCurlOfTheBooks) {
  const Result<Groom> groom = makeCurl();
  ASSERT_TRUE(groom);
  EXPECT_EQ(groom->points.size(), 64u);
  EXPECT_EQ(groom->points.front(), (Vec3f{1, 0, 0}));
  EXPECT_FLOAT_EQ(groom->points.back().y, -25);
  const CurlShape shape = measureCurl(metresOf(*groom, 0));
  EXPECT_NEAR(shape.turns, 8, 1e-4);
  EXPECT_NEAR(shape.radius, 0.01, 1e-6);
  EXPECT_NEAR(shape.pitch, 0.25 / 8, 1e-6);
  EXPECT_EQ(shape.handedness, 1);
}

TEST(MakeCurl, MayBeStraightOrCoarse) {
  const Result<Groom> straight = makeCurl({.turns = 0, .particleCount = 2, .metresPerUnit = 1});
  ASSERT_TRUE(straight) << straight.error().message;
  EXPECT_EQ(straight->points, (std::vector<Vec3f>{{0.01f, 0, 0}, {0.01f, -0.25f, 0}}));
  EXPECT_TRUE(makeCurl({.turns = 8, .particleCount = 16}));  // two particles a turn
}

TEST(MakeCurl, RefusesBadParameters) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN(),
                   kInfinity = std::numeric_limits<double>::infinity();
  for (double bad : {0.0, -1.0, 1.5, kNan, kInfinity}) {
    expectError(makeCurl({.radius = bad}), "the curl radius is ");
    expectError(makeCurl({.radius = bad}), "it must be more than 0 and at most 1 m");
  }
  for (double bad : {0.0, -0.1, 10.1, kNan}) expectError(makeCurl({.length = bad}), "the strand length is ");
  for (double bad : {-1.0, 1001.0, kNan}) expectError(makeCurl({.turns = bad}), "the number of turns is ");
  for (int bad : {-5, 0, 1, 65537, std::numeric_limits<int>::max()}) {
    expectError(makeCurl({.particleCount = bad}), "it must be between 2 and 65536");
  }
  for (int bad : {0, 2, -2}) expectError(makeCurl({.handedness = bad}), "the handedness is ");
  for (double bad : {kNan, kInfinity}) expectError(makeCurl({.phase = bad}), "the phase is ");
  for (double bad : {0.0, -1.0, kNan})
    expectError(makeCurl({.metresPerUnit = bad}), "the metres per unit is ");
}

TEST(MakeSwatch, StandsInRowsAndVariesWithinItsBounds) {
  SwatchParameters p{.columnCount = 12, .rowCount = 9, .spacing = 0.03};
  p.variation.radius = 0.2;
  p.variation.length = 0.15;
  const Result<Groom> groom = makeSwatch(p);
  ASSERT_TRUE(groom) << groom.error().message;
  ASSERT_EQ(groom->strandCount(), 108u);
  int leftCount = 0;
  double smallest = 1, largest = 0;
  for (std::size_t s = 0; s < 108; ++s) {
    const std::vector<Vec3d> strand = metresOf(*groom, s);
    const CurlShape shape = measureCurl(strand);
    // The core, from the formula of the grid: the root is one radius away from it.
    const double x = (double(s % 12) - 5.5) * 0.03, z = (double(s / 12) - 4) * 0.03;
    EXPECT_NEAR(std::hypot(strand[0].x - x, strand[0].z - z), shape.radius, 1e-6);
    EXPECT_EQ(strand[0].y, 0);
    EXPECT_NEAR(shape.radius, 0.01, 0.2001 * 0.01);
    EXPECT_NEAR(-strand.back().y, 0.25, 0.1501 * 0.25);
    EXPECT_NEAR(shape.pitch, 0.25 / 8, 1e-5);  // as many turns per metre, whatever the length
    leftCount += shape.handedness < 0;
    smallest = std::min(smallest, shape.radius);
    largest = std::max(largest, shape.radius);
  }
  EXPECT_GT(leftCount, 30);
  EXPECT_LT(leftCount, 78);
  EXPECT_LT(smallest, 0.0085);
  EXPECT_GT(largest, 0.0115);
}

TEST(MakeSwatch, WithoutVariationAllCurlsAreOne) {
  SwatchParameters p{.variation = {.radius = 0, .length = 0, .phase = 0, .leftHandedShare = 0},
                     .columnCount = 3,
                     .rowCount = 1};
  const Result<Groom> groom = makeSwatch(p), curl = makeCurl(p.curl);
  ASSERT_TRUE(groom && curl);
  for (std::size_t i = 0; i < 64; ++i)
    EXPECT_EQ(groom->strand(1)[i], curl->points[i]);  // the middle one, at the origin
}

TEST(MakeSwatch, RefusesBadParameters) {
  expectError(makeSwatch({.curl = {.radius = 0}}), "the curl radius is 0 m");
  expectError(makeSwatch({.columnCount = 0}), "the number of columns is 0; it must be between 1 and 10000");
  expectError(makeSwatch({.rowCount = 10001}), "the number of rows is 10001");
  expectError(makeSwatch({.spacing = 0}), "the spacing of the strands is 0 m");
  expectError(makeSwatch({.variation = {.radius = 1}}), "the variation of the curl radius is 1");
  expectError(makeSwatch({.variation = {.length = -0.1}}), "the variation of the length is -0.1");
  expectError(makeSwatch({.columnCount = 10000, .rowCount = 10000}), "at most 100000000 can be generated");
}

TEST(MakeHead, StandsOnTheScalpAboveTheHairlineAndStaysOutside) {
  for (std::uint64_t seed : {1, 2, 3}) {
    HeadParameters p{.strandCount = 600};
    p.variation.seed = seed;
    const Result<Groom> groom = makeHead(p);
    ASSERT_TRUE(groom) << groom.error().message;
    ASSERT_EQ(groom->strandCount(), 600u);
    for (std::size_t s = 0; s < 600; ++s) {
      const std::vector<Vec3d> strand = metresOf(*groom, s);
      ASSERT_EQ(strand.size(), 64u);
      const Vec3d normal = strand[0] / length(strand[0]);
      ASSERT_NEAR(length(strand[0]), 0.09, 1e-8) << "root of strand " << s;

      // The hairline is the plane through the elevations at brow and nape.
      const double along = std::cos(p.browElevation) + std::cos(p.napeElevation);
      const double rise = (std::sin(p.browElevation) - std::sin(p.napeElevation)) / along;
      ASSERT_GT(normal.y - std::sin(p.napeElevation), rise * (normal.z + std::cos(p.napeElevation)) - 1e-9);

      // It leaves along the normal, and never comes back to the skull or over the face.
      const Vec3d first = strand[1] - strand[0];
      ASSERT_GT(dot(first, normal) / length(first), 0.8) << "strand " << s;
      for (std::size_t i = 1; i < strand.size(); ++i) {
        ASSERT_GT(length(strand[i]), 0.0905) << "strand " << s << ", particle " << i;
        const bool isBeforeFace = strand[i].z > 0.06 && std::abs(strand[i].x) < 0.06 && strand[i].y < 0.04;
        ASSERT_FALSE(isBeforeFace) << "strand " << s << ", particle " << i;
      }
      // And hangs at its end: the last two turns go down.
      ASSERT_LT(strand[63].y, strand[48].y - 0.03) << "strand " << s;
    }
  }
}

TEST(MakeHead, IsEvenlySpread) {
  const Result<Groom> groom = makeHead({.strandCount = 500});
  ASSERT_TRUE(groom);
  // Cap area 2 pi R^2 (1 - sin((brow + nape) / 2)); the nearest root of an even spread is not far from
  // sqrt(area / count).
  const double mean = std::sqrt(2 * kPi * 0.09 * 0.09 * (1 - std::sin(0.075)) / 500);
  for (std::size_t a = 0; a < 500; ++a) {
    double nearest = 1;
    for (std::size_t b = 0; b < 500; ++b) {
      if (a != b) nearest = std::min(nearest, length(metresOf(*groom, a)[0] - metresOf(*groom, b)[0]));
    }
    EXPECT_GT(nearest, 0.6 * mean) << "strand " << a;
    EXPECT_LT(nearest, 1.3 * mean) << "strand " << a;
  }
}

TEST(MakeHead, WearsCurls) {
  const Result<Groom> groom = makeHead({.strandCount = 300});
  ASSERT_TRUE(groom);
  int leftCount = 0;
  for (std::size_t s = 0; s < 300; ++s) {
    const std::vector<Vec3d> strand = metresOf(*groom, s);
    const CurlShape shape = measureCurl(strand);
    // Particles are even along the core, so the strand is no shorter than it, and no longer than its helix.
    double arc = 0;
    for (std::size_t i = 1; i < strand.size(); ++i) arc += length(strand[i] - strand[i - 1]);
    EXPECT_GT(arc, 0.9 * 0.25);
    EXPECT_LT(arc, 1.21 * std::hypot(0.25, 2 * kPi * 0.01 * 8));
    EXPECT_GT(shape.turns, 6.5) << "strand " << s;
    EXPECT_LT(shape.turns, 9.5) << "strand " << s;
    EXPECT_NEAR(shape.radius, 0.0095, 0.002) << "strand " << s;  // it grows from 0 over a fifth of the strand
    leftCount += shape.handedness < 0;
  }
  EXPECT_GT(leftCount, 100);
  EXPECT_LT(leftCount, 200);
}

// How far a strand's points are from those of its nearest neighbour, beyond what their roots are [m].
double distanceOfNeighbours(const Groom& groom, const std::vector<std::size_t>& lock) {
  double sum = 0;
  for (std::size_t s = 0; s < groom.strandCount(); ++s) {
    const auto strand = metresOf(groom, s);
    double nearest = 1;
    std::vector<Vec3d> neighbour;
    for (std::size_t other = 0; other < groom.strandCount(); ++other) {
      const auto candidate = metresOf(groom, other);
      const double apart = length(candidate[0] - strand[0]);
      if (other == s || lock[other] != lock[s] || apart >= nearest) continue;
      nearest = apart;
      neighbour = candidate;
    }
    const std::size_t middle = strand.size() / 2;
    if (!neighbour.empty()) sum += length(neighbour[middle] - strand[middle]) - nearest;
  }
  return sum / static_cast<double>(groom.strandCount());
}

TEST(MakeHead, StrandsOfALockWindAlike) {
  constexpr int kLocks = 20;
  const Result<Groom> places = makeHead({.strandCount = kLocks}), each = makeHead({.strandCount = 400});
  const Result<Groom> groom = makeHead({.strandCount = 400, .lockCount = kLocks});
  ASSERT_TRUE(places && each && groom);
  std::vector<std::size_t> lock;
  std::vector<int> hands(kLocks, 0);
  std::vector<double> least(kLocks, 1e9), most(kLocks, 0);  // arc lengths [m]
  for (std::size_t s = 0; s < groom->strandCount(); ++s) {
    const auto strand = metresOf(*groom, s);
    EXPECT_EQ(strand[0], metresOf(*each, s)[0]) << "locks move no root";
    std::size_t nearest = 0;
    for (std::size_t place = 0; place < kLocks; ++place) {
      const auto apart = [&](std::size_t p) { return length(metresOf(*places, p)[0] - strand[0]); };
      if (apart(place) < apart(nearest)) nearest = place;
    }
    lock.push_back(nearest);
    const int hand = measureCurl(strand).handedness;
    if (hands[nearest] == 0) hands[nearest] = hand;
    EXPECT_EQ(hand, hands[nearest]) << "strand " << s;
    double arc = 0;
    for (std::size_t i = 1; i < strand.size(); ++i) arc += length(strand[i] - strand[i - 1]);
    least[nearest] = std::min(least[nearest], arc);
    most[nearest] = std::max(most[nearest], arc);
  }
  EXPECT_GT(std::ranges::count(hands, 1), 4);
  EXPECT_GT(std::ranges::count(hands, -1), 4);
  for (std::size_t k = 0; k < kLocks; ++k) {
    EXPECT_GT(most[k], 1.001 * least[k]) << "strands of a lock differ a little";
    EXPECT_LT(most[k], 1.04 * least[k]);
  }
  EXPECT_GT(std::ranges::max(most), 1.15 * std::ranges::min(least)) << "locks differ more";
  EXPECT_LT(distanceOfNeighbours(*groom, lock), 0.5 * distanceOfNeighbours(*each, lock))
      << "their curls lie side by side";
}

TEST(MakeHead, TheSeedDecides) {
  const Result<Groom> a = makeHead({.strandCount = 50}), b = makeHead({.strandCount = 50});
  const Result<Groom> other = makeHead({.variation = {.seed = 2}, .strandCount = 50});
  ASSERT_TRUE(a && b && other);
  EXPECT_TRUE(test::hasSameBits(*a, *b));
  EXPECT_FALSE(test::hasSameBits(*a, *other));
  EXPECT_EQ(a->points[0], other->points[0]);  // roots do not depend on it
}

TEST(MakeHead, RefusesBadParameters) {
  expectError(makeHead({.curl = {.particleCount = 1}}), "the number of particles per strand is 1");
  expectError(makeHead({.strandCount = 0}), "the number of strands is 0; it must be between 1 and 1000000");
  expectError(makeHead({.lockCount = -1}), "the number of locks is -1; it must be between 0 and 10000");
  expectError(makeHead({.lockCount = 10001}), "the number of locks is 10001;");
  expectError(makeHead({.scalpRadius = 0.01}),
              "the scalp radius is 0.01 m; it must be between 0.02 and 10 m");
  expectError(makeHead({.browElevation = 2}), "the elevation of the hairline at the brow is 2 rad");
  expectError(makeHead({.napeElevation = -2}), "at the nape is -2 rad");
  expectError(makeHead({.bendLength = 0}), "bend over is 0 m");
  expectError(makeHead({.rampShare = 0}), "curl grows is 0;");
  expectError(makeHead({.variation = {.leftHandedShare = 1.1}}), "the share of left-handed strands is 1.1");
  expectError(makeHead({.curl = {.particleCount = 65536}, .strandCount = 1000000}),
              "at most 100000000 can be generated");
}

TEST(MakeHead, SurvivesExtremeParameters) {
  for (double scalpRadius : {0.02, 0.09, 10.0}) {
    for (double radius : {1e-6, 0.01}) {
      for (double bend : {1e-6, 10.0}) {
        const Result<Groom> groom =
            makeHead({.curl = {.radius = radius, .turns = 100, .length = 1, .particleCount = 9},
                      .strandCount = 7,
                      .scalpRadius = scalpRadius,
                      .browElevation = 1.5,
                      .napeElevation = -1.5,
                      .bendLength = bend,
                      .rampShare = 1e-9});
        ASSERT_TRUE(groom) << groom.error().message;
        EXPECT_TRUE(test::isUsable(*groom));
        for (std::size_t s = 0; s < 7; ++s) {
          for (Vec3d p : metresOf(*groom, s)) EXPECT_GT(length(p), 0.9999999 * scalpRadius);
        }
      }
    }
  }
}

// Of every style.
std::vector<HeadParameters> styledHeads() {
  std::vector<HeadParameters> heads;
  for (const std::string& name : test::styleNames()) {
    const auto head = headOfStyle(name);
    EXPECT_TRUE(head) << name;
    heads.push_back(*head);
    heads.back().strandCount = 400;
    heads.back().curl.particleCount = 64;
    heads.back().curl.metresPerUnit = 1;
  }
  return heads;
}
double arcOf(const std::vector<Vec3d>& strand) {
  double arc = 0;
  for (std::size_t i = 1; i < strand.size(); ++i) arc += length(strand[i] - strand[i - 1]);
  return arc;
}

TEST(MakeHead, StylesGrowOnTheScalpAndStayOutsideTheHead) {
  EXPECT_FALSE(headOfStyle("mullet"));
  for (const HeadParameters& head : styledHeads()) {
    const Result<Groom> groom = makeHead(head);
    ASSERT_TRUE(groom) << groom.error().message;
    ASSERT_EQ(groom->strandCount(), 400u);
    std::size_t left = 0, fringe = 0;
    for (std::size_t s = 0; s < groom->strandCount(); ++s) {
      const std::vector<Vec3d> strand = metresOf(*groom, s);
      EXPECT_NEAR(length(strand[0]), head.scalpRadius, 1e-6);
      EXPECT_TRUE(isAboveHairline(head, strand[0] / head.scalpRadius));
      for (const Vec3d p : strand) EXPECT_GT(length(p), head.scalpRadius - 1e-6) << "strand " << s;
      left += strand[0].x > 0;
      fringe += isFringe(head, strand[0] / head.scalpRadius);
    }
    EXPECT_NEAR(static_cast<double>(left), 200, 10) << "the scalp has two like sides";
    EXPECT_EQ(fringe > 0, head.cut.fringe > 0);
  }
}

TEST(MakeHead, TheNaturalHairlineHasBaysAndRoomForEars) {
  HeadParameters cap{.strandCount = 3000}, natural = cap;
  cap.curl.metresPerUnit = natural.curl.metresPerUnit = 1;
  natural.cut.hairline = "natural";
  const auto lowest = [](const Groom& groom, double azimuth) {
    double least = 2;
    for (std::size_t s = 0; s < groom.strandCount(); ++s) {
      const Vec3d root = metresOf(groom, s)[0];
      if (std::abs(std::atan2(std::abs(root.x), root.z) - azimuth) < 0.1)
        least = std::min(least, std::asin(root.y / length(root)));
    }
    return least;
  };
  const Groom a = *makeHead(cap), b = *makeHead(natural);
  EXPECT_NEAR(lowest(b, 0.05), lowest(a, 0.05), 0.05);
  EXPECT_NEAR(lowest(b, 3.05), lowest(a, 3.05), 0.05);
  EXPECT_NEAR(lowest(b, 0.62) - lowest(a, 0.62), 0.16, 0.06);
  EXPECT_NEAR(lowest(b, 1.6) - lowest(a, 1.6), 0.2, 0.06);
}

TEST(MakeHead, HairFallsToEitherSideOfAParting) {
  for (const char* parting : {"left", "middle", "right"}) {
    HeadParameters head{.strandCount = 600};
    head.curl.metresPerUnit = 1;
    head.cut.parting = parting;
    const Groom groom = *makeHead(head);
    std::size_t near = 0;
    for (std::size_t s = 0; s < groom.strandCount(); ++s) {
      const std::vector<Vec3d> strand = metresOf(groom, s);
      if (strand[0].y < 0.75 * head.scalpRadius || strand[0].z < 0) continue;  // on top, in front
      const int side = sideOfParting(head, strand[0] / head.scalpRadius);
      const double line = parting == std::string("left") ? 0.03 : parting == std::string("right") ? -0.03 : 0;
      EXPECT_GT((strand.back().x - line) * side, 0.02) << parting << " " << s;
      ++near;
    }
    EXPECT_GT(near, 20u);
  }
}

TEST(MakeHead, LengthsFollowTheCut) {
  HeadParameters head{.variation = {.radius = 0, .length = 0}, .strandCount = 500};
  head.curl.metresPerUnit = 1;
  head.curl.turns = 0;
  head.curl.radius = 1e-4;
  const auto arcs = [&](const HairCut& cut) {
    head.cut = cut;
    const Groom groom = *makeHead(head);
    std::vector<std::pair<Vec3d, double>> all;
    for (std::size_t s = 0; s < groom.strandCount(); ++s)
      all.emplace_back(metresOf(groom, s)[0] / head.scalpRadius,
                       arcOf(metresOf(groom, s)) / head.curl.length);
    return all;
  };
  for (const auto& [d, arc] : arcs({.top = 2, .sides = 0.5, .back = 0.7})) {
    if (d.y > 0.86) {
      EXPECT_NEAR(arc, 2, 0.02);
    }
    if (d.y < 0.59 && d.z < -0.61) {
      EXPECT_NEAR(arc, 0.7, 0.007);
    }
    if (d.y < 0.59 && d.z > -0.09) {
      EXPECT_NEAR(arc, 0.5, 0.005);
    }
  }
  for (const auto& [d, arc] : arcs({.fringe = 0.06}))
    EXPECT_NEAR(arc, isFringe(head, d) ? 0.06 / head.curl.length : 1, 0.01);
  double crown = 0, nape = 0;
  for (const auto& [d, arc] : arcs({.layers = 0.5})) {
    if (d.y > 0.98) crown = arc;
    if (d.y < -0.5) nape = arc;
  }
  EXPECT_NEAR(crown, 0.5, 0.01);
  EXPECT_NEAR(nape, 1, 0.02);
}

TEST(MakeHead, EndsAreLevelAndRootsStraight) {
  HeadParameters head{.strandCount = 300};
  head.curl.metresPerUnit = 1;
  head.curl.length = 0.4;
  head.curl.particleCount = 256;
  head.cut.level = 0.12;
  std::size_t level = 0;
  Groom groom = *makeHead(head);
  for (std::size_t s = 0; s < groom.strandCount(); ++s) {
    const double tip = metresOf(groom, s).back().y;
    EXPECT_GT(tip, -0.13);
    level += std::abs(tip + 0.12) < 0.004;
  }
  EXPECT_GT(level, 290u);

  // Half of a strand without its curl is as long as its core, the other half longer.
  head.cut = {.straightRoot = 0.5};
  head.curl.turns = 20;
  groom = *makeHead(head);
  for (std::size_t s = 0; s < groom.strandCount(); ++s) {
    const std::vector<Vec3d> strand = metresOf(groom, s);
    const double edge = head.curl.length / 255;
    const double first = arcOf({strand.begin(), strand.begin() + 128}) / (127 * edge);
    EXPECT_LT(first, 1.15);
    EXPECT_GT(arcOf({strand.begin() + 170, strand.end()}) / (85 * edge), 1.5 * first);
  }
}

TEST(MakeHead, ClumpsComeTogetherAtTheTip) {
  HeadParameters head{.strandCount = 600, .lockCount = 60};
  head.curl.metresPerUnit = 1;
  const auto spread = [&](double share) {
    head.cut.clump = share;
    const Groom groom = *makeHead(head);
    double sum = 0;  // from each tip to the nearest other one
    for (std::size_t s = 0; s < groom.strandCount(); ++s) {
      double least = 1;
      for (std::size_t t = 0; t < groom.strandCount(); ++t)
        if (t != s) least = std::min(least, length(metresOf(groom, s).back() - metresOf(groom, t).back()));
      sum += least;
    }
    return sum / static_cast<double>(groom.strandCount());
  };
  const double apart = spread(0), together = spread(0.8);
  EXPECT_LT(together, 0.7 * apart);
}

TEST(MakeHead, RefusesBadCuts) {
  const auto with = [](auto set) {
    HeadParameters head{.strandCount = 10};
    set(head.cut);
    return makeHead(head);
  };
  expectError(with([](HairCut& c) { c.hairline = "low"; }),
              "the hairline is 'low'; it must be one of cap, natural");
  expectError(with([](HairCut& c) { c.parting = "centre"; }),
              "the parting is 'centre'; it must be one of none, left");
  expectError(with([](HairCut& c) { c.top = 0; }), "the factor on the length on top is 0");
  expectError(with([](HairCut& c) { c.layers = 1; }), "the share of the layers is 1");
  expectError(with([](HairCut& c) { c.level = NAN; }), "the level of the ends is nan");
  expectError(with([](HairCut& c) { c.clump = 1.5; }), "the share of clumping is 1.5");
  expectError(with([](HairCut& c) { c.straightRoot = -1; }), "the share of a straight root is -1");
  expectError(with([](HairCut& c) { c.fringe = -1; }), "the length of the fringe is -1");
}

TEST(SeededRandom, IsSplitMix64) {
  // Uniform: the mean of many draws, and no draw twice.
  SeededRandom random(1, 0);
  double sum = 0;
  std::set<double> seen;
  for (int i = 0; i < 10000; ++i) {
    const double value = random.uniform();
    ASSERT_GE(value, 0);
    ASSERT_LT(value, 1);
    sum += value;
    seen.insert(value);
  }
  EXPECT_NEAR(sum / 10000, 0.5, 0.015);  // five standard deviations
  EXPECT_EQ(seen.size(), 10000u);

  // Streams and seeds differ.
  EXPECT_NE(SeededRandom(1, 0).uniform(), SeededRandom(1, 1).uniform());
  EXPECT_NE(SeededRandom(1, 0).uniform(), SeededRandom(2, 0).uniform());
}

}  // namespace
}  // namespace ringlet::generate_test
