// Roots of hairs on a scalp mesh: where they are, how evenly, and what a map of density leaves of them.
#include "ringlet/follow/scalp_roots.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "ringlet/bodies/icosphere.h"
#include "ringlet/bodies/triangle_tree.h"
#include "ringlet/follow/follow_hairs.h"
#include "ringlet/follow/near_guides.h"
#include "ringlet/groom/generate.h"

namespace ringlet::scalp_roots_test {
namespace {

constexpr double kRadius = 0.09;  // of generated heads [m]

std::vector<GuideRest> headOf(int strands) {
  const Result<Groom> groom = makeHead({.curl = {.turns = 0}, .strandCount = strands});
  std::vector<GuideRest> rests;
  for (std::size_t s = 0; s < groom->strandCount(); ++s) {
    std::vector<Vec3d> strand;
    for (const Vec3f& p : groom->strand(s)) strand.push_back(Vec3d(p) * groom->metresPerUnit);
    rests.push_back(restOfGuide(strand));
  }
  return rests;
}

// A ball of triangles, with another inside that faces the middle, as shells have.
TriangleMesh shellOf(double thickness) {
  TriangleMesh mesh = makeIcosphere(16);
  const auto count = static_cast<std::uint32_t>(mesh.points.size());
  const std::size_t triangles = mesh.triangles.size();
  for (std::uint32_t i = 0; i < count; ++i) {
    const Vec3d outward = normalizedOr(mesh.points[i], Vec3d{0, 1, 0});
    mesh.points[i] = outward * kRadius;
    mesh.points.push_back(outward * (kRadius - thickness));
  }
  for (std::size_t t = 0; t < triangles; ++t) {
    const auto [a, b, c] = mesh.triangles[t];
    mesh.triangles.push_back({a + count, c + count, b + count});
  }
  return mesh;
}

double nearestOther(const std::vector<Vec3d>& places, std::size_t i) {
  double best = INFINITY;
  for (std::size_t k = 0; k < places.size(); ++k)
    if (k != i) best = std::min(best, length(places[k] - places[i]));
  return best;
}

// How far the nearest other is, of the closest root and of the one in the middle [m].
struct Spacing {
  double least = 0, median = 0;
};
Spacing spacingOf(const std::vector<Vec3d>& places) {
  std::vector<double> nearest;
  for (std::size_t i = 0; i < places.size(); ++i) nearest.push_back(nearestOther(places, i));
  std::ranges::sort(nearest);
  return {nearest.front(), nearest[nearest.size() / 2]};
}

TEST(ScalpRoots, AreOnTheMeshAsFarApartAsBlueNoise) {
  const auto guides = headOf(150);
  const TriangleMesh shell = shellOf(0.001);
  const auto roots = scatterRoots(shell, guides, 3000, 1);
  ASSERT_TRUE(roots) << roots.error().message;
  ASSERT_EQ(roots->places.size(), 3000u);
  const TriangleTree tree(shell);
  const NearGuides near(guides);
  for (const Vec3d& place : roots->places) {
    ASSERT_LT(tree.nearest(place).distance, 1e-9);
    ASSERT_GT(length(place), kRadius - 0.0005) << "none is on the inside";
    ASSERT_LT(near.at(place, 1).front().distance, 0.03);
  }
  const Spacing all = spacingOf(roots->places);
  EXPECT_GT(all.least, 0.55 * all.median) << "of random places 0.04";
}

TEST(ScalpRoots, AreTheSameForASeed) {
  const auto guides = headOf(60);
  const TriangleMesh shell = shellOf(0.001);
  const auto once = scatterRoots(shell, guides, 500, 1), again = scatterRoots(shell, guides, 500, 1),
             other = scatterRoots(shell, guides, 500, 2);
  EXPECT_EQ(once->places, again->places);
  EXPECT_EQ(once->ranks, again->ranks);
  EXPECT_TRUE(once->places != other->places);
}

TEST(ScalpRoots, RanksLeaveEvenParts) {
  const auto guides = headOf(150);
  const auto roots = scatterRoots(shellOf(0.001), guides, 3000, 1);
  for (const double share : {0.125, 0.25, 0.3, 0.5, 0.75}) {
    std::vector<Vec3d> left;
    for (std::size_t i = 0; i < roots->places.size(); ++i)
      if (roots->ranks[i] <= share) left.push_back(roots->places[i]);
    EXPECT_NEAR(static_cast<double>(left.size()) / 3000, share, 0.03);
    // Between two levels every second is left by chance.
    const Spacing spacing = spacingOf(left);
    EXPECT_GT(spacing.least, 0.25 * spacing.median) << share;
  }
}

TEST(ScalpRoots, DensityThinsAndLeavesTheOthersAsTheyAre) {
  const auto guides = headOf(200);
  const auto roots = scatterRoots(shellOf(0.001), guides, 8000, 1);
  std::vector<float> density;
  for (const GuideRest& guide : guides) density.push_back(guide.root.x > 0 ? 0.25f : 1.0f);
  std::vector<std::uint32_t> rootOf, thinnedRootOf;
  const auto all = planHairs(guides, *roots, {}, {}, &rootOf);
  const auto thinned = planHairs(guides, *roots, {}, {.density = density, .clump = {}}, &thinnedRootOf);
  ASSERT_TRUE(all && thinned);
  ASSERT_EQ(all->size(), 8000u);
  const auto countWhere = [&](const std::vector<std::uint32_t>& which, auto&& isThere) {
    return std::ranges::count_if(which, [&](std::uint32_t i) { return isThere(roots->places[i].x); });
  };
  const auto share = [&](auto&& isThere) {
    return static_cast<double>(countWhere(thinnedRootOf, isThere)) /
           static_cast<double>(countWhere(rootOf, isThere));
  };
  // Between the two there is a strip of a guide's distance.
  EXPECT_NEAR(share([](double x) { return x > 0.02; }), 0.25, 0.03);
  EXPECT_NEAR(share([](double x) { return x < -0.02; }), 1, 1e-9);
  EXPECT_NEAR(share([](double x) { return std::abs(x) < 0.004; }), 0.62, 0.2);
  for (std::size_t h = 0; h < thinned->size(); ++h) {
    const auto at = std::ranges::find(rootOf, thinnedRootOf[h]) - rootOf.begin();
    const FollowHair& same = (*all)[static_cast<std::size_t>(at)];
    ASSERT_EQ((*thinned)[h].phase, same.phase);
    ASSERT_EQ((*thinned)[h].offset, same.offset);
  }
  const std::vector<float> none(guides.size(), 0.0f);
  EXPECT_EQ(planHairs(guides, *roots, {}, {.density = none, .clump = {}}).error().message,
            "the map of density leaves no hair; ask for more hairs");
}

TEST(ScalpRoots, HairsFollowTheNearestGuide) {
  const auto guides = headOf(100);
  const auto roots = scatterRoots(shellOf(0.001), guides, 1000, 1);
  std::vector<std::uint32_t> rootOf;
  const auto hairs = planHairs(guides, *roots, {}, {}, &rootOf);
  ASSERT_TRUE(std::ranges::is_sorted(*hairs, {}, &FollowHair::guide));
  for (std::size_t h = 0; h < hairs->size(); ++h) {
    const FollowHair& hair = (*hairs)[h];
    const GuideRest& guide = guides[hair.guide];
    const Vec3d offset(hair.offset);
    const Vec3d root = guide.root + guide.frame.normal * offset.x + guide.frame.binormal * offset.y +
                       guide.frame.tangent * offset.z;
    ASSERT_LT(length(root - roots->places[rootOf[h]]), 1e-7);
    for (const GuideRest& other : guides)
      ASSERT_LE(length(root - guide.root), length(root - other.root) + 1e-7);
  }
}

TEST(ScalpRoots, AMeshElsewhereIsRefused) {
  const auto guides = headOf(20);
  TriangleMesh far = shellOf(0.001);
  for (Vec3d& point : far.points) point += Vec3d{0.1, 0, 0};
  const auto roots = scatterRoots(far, guides, 100, 1);
  ASSERT_FALSE(roots);
  EXPECT_NE(roots.error().message.find("m from the mesh that hairs grow on"), std::string::npos);
}

// Without a mesh a guide has its share of hairs; hairs gather as the map says.
TEST(PlanHairs, MapsAreOfGuides) {
  const auto guides = headOf(40);
  std::vector<float> density(40, 1.0f), clump(40, 1.0f);
  for (std::size_t g = 0; g < 20; ++g) density[g] = 0.5f, clump[g] = 4;
  const auto hairs =
      planHairs(guides, {.hairCount = 4000, .strayShare = 0}, {.density = density, .clump = clump});
  ASSERT_EQ(hairs->size(), 3000u);
  double spread[2]{}, counts[2]{};
  for (const FollowHair& hair : *hairs) {
    counts[hair.guide < 20] += 1;
    spread[hair.guide < 20] += static_cast<double>(hair.spread);
  }
  EXPECT_EQ(counts[1], 1000);
  EXPECT_NEAR(spread[0] / counts[0], 0.75, 0.02);
  EXPECT_NEAR(spread[1] / counts[1], 0.3, 0.05) << "the mean of what varies about 0";
}

// Guides with their roots at these distances [m] from the origin, each to another side; the last is nearest.
std::vector<GuideRest> guidesAt(std::vector<double> distances) {
  const Vec3d ways[] = {{0.6, 0.8, 0}, {0, -1, 0}, {0, 0.28, 0.96}, {-1, 0, 0}, {0, 0.6, -0.8}};
  std::vector<GuideRest> guides;
  for (std::size_t g = 0; g < distances.size(); ++g) {
    guides.emplace_back();
    guides.back().root = ways[g] * distances[g];
  }
  return guides;
}

// Franke and Nielson 1980: of guides at d, the fourth at R, shares are as ((R - d) / (R d))^2.
TEST(NearGuides, SharesAreThoseOfTheFormula) {
  const double R = 0.04;
  const auto weight = [&](double d) { return std::pow((R - d) / (R * d), 2); };
  const double sum = weight(0.01) + weight(0.02) + weight(0.03);
  const auto shares = NearGuides(guidesAt({0.05, R, 0.03, 0.02, 0.01})).sharesAt({});
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(shares[k].guide, 4 - k);
    EXPECT_NEAR(shares[k].share, weight(0.01 * double(k + 1)) / sum, 1e-12) << k;
  }
}

// No fourth is where shares end: they are as 1 / d^2.
TEST(NearGuides, SharesOfFewGuidesEndNowhere) {
  const auto three = NearGuides(guidesAt({0.03, 0.02, 0.01})).sharesAt({});
  const double sum = 1 + 1 / 4.0 + 1 / 9.0;
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_NEAR(three[k].share, 1 / (double(k + 1) * double(k + 1) * sum), 1e-12) << k;
  const auto two = NearGuides(guidesAt({0.02, 0.01})).sharesAt({});
  EXPECT_NEAR(two[0].share, 0.8, 1e-12);
  EXPECT_NEAR(two[1].share, 0.2, 1e-12);
  EXPECT_EQ(two[2].share, 0);
  EXPECT_EQ(NearGuides(guidesAt({0.01})).sharesAt({})[0].share, 1);
}

// On a guide's root that guide leads alone; where all four are equally far, the first does.
TEST(NearGuides, SharesWhereGuidesStand) {
  const auto guides = guidesAt({0.04, 0.03, 0.02, 0.01});
  for (std::uint32_t g = 0; g < 4; ++g) {
    const auto shares = NearGuides(guides).sharesAt(guides[g].root);
    EXPECT_EQ(shares[0].guide, g);
    EXPECT_NEAR(shares[0].share, 1, 1e-9);
  }
  const auto equal = NearGuides(guidesAt({0.02, 0.02, 0.02, 0.02})).sharesAt({});
  EXPECT_EQ(equal[0].share + equal[1].share + equal[2].share, 1);
}

TEST(NearGuides, AreTheNearestOfAll) {
  const auto guides = headOf(100);
  const NearGuides near(guides);
  for (int i = 0; i < 50; ++i) {
    const Vec3d place = guides[static_cast<std::size_t>(2 * i)].root + Vec3d{0.003, -0.001 * i, 0.002};
    std::vector<double> distances;
    for (const GuideRest& guide : guides) distances.push_back(length(guide.root - place));
    std::ranges::sort(distances);
    const auto found = near.at(place, 6);
    ASSERT_EQ(found.size(), 6u);
    for (std::size_t k = 0; k < 6; ++k) {
      EXPECT_EQ(found[k].distance, distances[k]) << k;
      EXPECT_EQ(length(guides[found[k].guide].root - place), distances[k]) << k;
    }
  }
}

TEST(NearGuides, SharesAreContinuous) {
  const auto guides = headOf(100);
  const NearGuides near(guides);
  std::vector<double> before(guides.size());
  double largest = 0;
  for (int i = 0; i <= 4000; ++i) {
    const double angle = 1.2 * (i / 4000.0) - 0.6;
    const Vec3d place{kRadius * std::sin(angle), kRadius * std::cos(angle), 0.003};
    std::vector<double> now(guides.size());
    double sum = 0;
    for (const auto& each : near.sharesAt(place)) now[each.guide] += each.share, sum += each.share;
    EXPECT_NEAR(sum, 1, 1e-12);
    for (std::size_t g = 0; g < now.size() && i > 0; ++g)
      largest = std::max(largest, std::abs(now[g] - before[g]));
    before = now;
  }
  EXPECT_LT(largest, 0.02) << "in a step of 0.03 mm";
}

}  // namespace
}  // namespace ringlet::scalp_roots_test
