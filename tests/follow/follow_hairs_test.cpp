// Which hairs follow which guides: evenness of roots, variation, blends, and what is refused.
#include "ringlet/follow/follow_hairs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "ringlet/follow/near_guides.h"
#include "ringlet/groom/curl_shape.h"
#include "tests/follow/guide_samples.h"

namespace ringlet::follow_hairs_test {
namespace {

using namespace test;

TEST(PlanHairs, RootsAreEvenAndNearestToTheirGuide) {
  constexpr int kHairs = 6000;
  constexpr int kGuides = 600;  // 8 mm apart
  const auto strands = headOf(kGuides);
  const auto rests = restsOf(strands);
  const auto hairs = planHairs(rests, {.hairCount = kHairs});
  ASSERT_TRUE(hairs);
  ASSERT_EQ(hairs->size(), kHairs);
  std::vector<int> counts(rests.size(), 0);
  std::vector<Vec3d> roots;
  std::size_t nearerToAnother = 0;
  double offScalp = 0;
  for (const FollowHair& hair : *hairs) {
    ++counts[hair.guide];
    const MeasuringFrame& frame = rests[hair.guide].frame;
    const Vec3d offset = Vec3d(hair.offset);
    const Vec3d root = rests[hair.guide].root + frame.normal * offset.x + frame.binormal * offset.y +
                       frame.tangent * offset.z;
    for (const GuideRest& other : rests)
      nearerToAnother += length(root - other.root) < length(root - rests[hair.guide].root) - 1e-6;
    offScalp = std::max(offScalp, std::abs(length(root) - 0.09));
    roots.push_back(root);
  }
  EXPECT_EQ(std::ranges::count(counts, kHairs / kGuides), kGuides);
  EXPECT_EQ(nearerToAnother, 0u);
  EXPECT_LT(offScalp, 1e-4);
  // How even: the nearest other place of nearly all is not far below the mean one.
  std::vector<double> nearest;
  for (std::size_t i = 0; i < roots.size(); i += 7) {
    double best = 1;
    for (std::size_t k = 0; k < roots.size(); ++k)
      if (k != i) best = std::min(best, length(roots[k] - roots[i]));
    nearest.push_back(best);
  }
  const double spacing = median(nearest);
  EXPECT_NEAR(spacing, 0.0026, 0.0006);  // 6,000 on the cap
  std::ranges::sort(nearest);
  EXPECT_GT(nearest[nearest.size() / 20], 0.35 * spacing) << "of random places: 0.27";
}

TEST(PlanHairs, CountsNeedNotDivide) {
  const auto rests = restsOf(headOf(7));
  for (const int count : {1, 6, 7, 8, 100}) {
    const auto hairs = planHairs(rests, {.hairCount = count});
    ASSERT_TRUE(hairs);
    EXPECT_EQ(hairs->size(), static_cast<std::size_t>(count));
    EXPECT_TRUE(std::ranges::is_sorted(*hairs, {}, &FollowHair::guide));
  }
  const auto one = planHairs(std::span(rests).first(1), {.hairCount = 50});
  ASSERT_TRUE(one);
  for (const FollowHair& hair : *one) EXPECT_LE(length(Vec3d(hair.offset)), 0.0025 * 1.001);
}

// Five roots a nanometre apart, a centimetre from the next five: most of the ground is nearer to another.
TEST(PlanHairs, RootsMayBeInClusters) {
  std::vector<GuideRest> rests;
  for (int i = 0; i < 50; ++i) {
    const double x = 0.01 * (i / 5 % 5), y = 0.01 * (i / 25), angle = 2 * std::numbers::pi * (i % 5) / 5;
    const Vec3d root{x + 1e-9 * std::cos(angle), y, 1e-9 * std::sin(angle)};
    rests.push_back(restOfGuide(Strand{root, root + Vec3d{0, -0.1, 0.01}, root + Vec3d{0, -0.2, 0}}));
  }
  rests.push_back(restOfGuide(Strand{{0, 0, 0}, {0, -0.1, 0.01}, {0, -0.2, 0}}));  // in the middle of five
  const auto hairs = planHairs(rests, {.hairCount = 510});
  ASSERT_TRUE(hairs);
  EXPECT_EQ(hairs->size(), 510u);
  EXPECT_LT(length(Vec3d(hairs->back().offset)), 1e-9) << "it has no more ground than that";
}

// A factor on three options, up to what each may be; draws stay the same.
TEST(PlanHairs, FrizzIsAFactor) {
  const auto rests = restsOf(headOf(20));
  const auto plan = [&](const FollowOptions& options) { return *planHairs(rests, options); };
  const auto expectSame = [](const std::vector<FollowHair>& a, const std::vector<FollowHair>& b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t h = 0; h < a.size(); ++h) {
      EXPECT_EQ(a[h].phase, b[h].phase) << h;
      EXPECT_EQ(a[h].radius, b[h].radius) << h;
      EXPECT_EQ(a[h].length, b[h].length) << h;
      EXPECT_EQ(a[h].spread, b[h].spread) << h;
    }
  };
  expectSame(plan({.hairCount = 900, .frizz = 0}),
             plan({.hairCount = 900, .phase = 0, .radius = 0, .strayShare = 0}));
  expectSame(plan({.hairCount = 900, .frizz = 2}),
             plan({.hairCount = 900, .phase = 0.9, .radius = 0.24, .strayShare = 0.2}));
  expectSame(plan({.hairCount = 900, .phase = 2, .radius = 0.5, .strayShare = 0.3, .frizz = 10}),
             plan({.hairCount = 900, .phase = std::numbers::pi, .radius = 0.9, .strayShare = 1}));
}

// As NearGuides shares them, by so much; nothing else of a hair changes.
TEST(PlanHairs, BlendIsAShare) {
  const auto rests = restsOf(straight(headOf(80), [](Vec3d) { return Vec3d{0, -0.2, 0}; }));
  const auto plan = [&](double blend) { return *planHairs(rests, {.hairCount = 900, .blend = blend}); };
  const auto none = plan(0), half = plan(0.5), all = plan(1);
  const NearGuides near(rests);
  ASSERT_EQ(none.size(), all.size());
  double most = 0;
  for (std::size_t h = 0; h < all.size(); ++h) {
    EXPECT_EQ(none[h].offset, all[h].offset);
    EXPECT_EQ(none[h].phase, all[h].phase);
    EXPECT_EQ(none[h].guide, all[h].guide);
    const GuideRest& guide = rests[all[h].guide];
    const auto inGroom = [](const MeasuringFrame& frame, Vec3f v) {
      return frame.normal * double(v.x) + frame.binormal * double(v.y) + frame.tangent * double(v.z);
    };
    const Vec3d root = guide.root + inGroom(guide.frame, all[h].offset);
    const auto shares = near.sharesAt(root);
    EXPECT_EQ(shares[0].guide, all[h].guide);
    for (std::size_t k = 0; k < 2; ++k) {
      const FollowHair::Other& other = all[h].others[k];
      EXPECT_EQ(none[h].others[k].share, 0);
      EXPECT_NEAR(other.share, shares[k + 1].share, 1e-4);
      EXPECT_NEAR(half[h].others[k].share, 0.5 * shares[k + 1].share, 1e-4);
      if (other.share == 0) continue;
      EXPECT_EQ(other.guide, shares[k + 1].guide);
      const GuideRest& its = rests[other.guide];
      EXPECT_LT(length(its.root + inGroom(its.frame, other.offset) - root), 1e-7);
    }
    most = std::max(most, double(all[h].others[0].share));
  }
  EXPECT_GT(most, 0.3);
  EXPECT_LE(most, 0.5 + 1e-6) << "the guide itself is nearest";
}

// Hair combed to both sides: blends keep to theirs.
TEST(PlanHairs, GuidesThatPartAreNotBlended) {
  const auto rests = restsOf(straight(headOf(200), [](Vec3d root) {
    return Vec3d{root.x < 0 ? -0.1 : 0.1, -0.2, 0};
  }));
  const auto hairs = planHairs(rests, {.hairCount = 4000, .blend = 1});
  ASSERT_TRUE(hairs);
  std::size_t blended = 0;
  for (const FollowHair& hair : *hairs) {
    const bool isLeft = rests[hair.guide].root.x < 0;
    for (const FollowHair::Other& other : hair.others) {
      if (other.share == 0) continue;
      ++blended;
      EXPECT_EQ(rests[other.guide].root.x < 0, isLeft);
    }
  }
  EXPECT_GT(blended, 2000u);
}

// Each piece of a guide goes its own way once it is cut.
TEST(PlanHairs, GuidesThatAreCutAreNotBlended) {
  auto rests = restsOf(headOf(100));
  for (std::size_t g = 0; g < rests.size(); g += 3) rests[g].pieces = {4};
  const auto hairs = planHairs(rests, {.hairCount = 2000, .blend = 1});
  ASSERT_TRUE(hairs);
  std::size_t blended = 0;
  for (const FollowHair& hair : *hairs) {
    for (const FollowHair::Other& other : hair.others) {
      if (other.share == 0) continue;
      ++blended;
      EXPECT_TRUE(rests[hair.guide].pieces.empty() && rests[other.guide].pieces.empty());
    }
  }
  EXPECT_GT(blended, 500u);
}

TEST(PlanHairs, OptionsSayHowHairsDiffer) {
  const auto rests = restsOf(headOf(20));
  const auto plan = [&](const FollowOptions& options) { return *planHairs(rests, options); };
  const auto alike =
      plan({.hairCount = 2000, .phase = 0, .radius = 0, .length = 0, .gather = 0, .strayShare = 0});
  for (const FollowHair& hair : alike) {
    EXPECT_EQ(hair.phase, 0);
    EXPECT_EQ(hair.radius, 1);
    EXPECT_EQ(hair.length, 1);
    EXPECT_EQ(hair.spread, 1);
  }
  const auto hairs = plan({.hairCount = 2000});
  const auto strays = std::ranges::count(hairs, 1.4f, &FollowHair::spread);
  EXPECT_NEAR(static_cast<double>(strays), 200, 60);
  double widest = 0, narrowest = 2, shortest = 2, turned = 0;
  for (const FollowHair& hair : hairs) {
    widest = std::max(widest, double(hair.radius));
    narrowest = std::min(narrowest, double(hair.radius));
    shortest = std::min(shortest, double(hair.length));
    if (hair.spread < 1.4f) turned = std::max(turned, std::abs(double(hair.phase)));
  }
  EXPECT_NEAR(widest, 1.12, 0.005);
  EXPECT_NEAR(narrowest, 0.88, 0.005);
  EXPECT_NEAR(shortest, 0.85, 0.005);
  EXPECT_NEAR(turned, 0.43, 0.03);
  const auto again = plan({.hairCount = 2000}), other = plan({.hairCount = 2000, .seed = 2});
  const auto isSame = [](const FollowHair& a, const FollowHair& b) {
    return a.offset == b.offset && a.phase == b.phase && a.radius == b.radius && a.length == b.length &&
           a.spread == b.spread;
  };
  EXPECT_TRUE(std::ranges::equal(hairs, again, isSame));
  EXPECT_FALSE(std::ranges::equal(hairs, other, isSame));
}

TEST(PlanHairs, RootsStayWithinReach) {
  const auto rests = restsOf(headOf(20));
  const auto farthest = [&](double reach) {
    double distance = 0;
    const auto hairs = *planHairs(rests, {.hairCount = 2000, .reach = reach});
    for (const FollowHair& hair : hairs) distance = std::max(distance, length(Vec3d(hair.offset)));
    return distance;
  };
  EXPECT_NEAR(farthest(0.0025), 0.0025, 0.0002) << "also where the scalp is steep";
  EXPECT_GT(farthest(1), 0.01) << "else as far as the guide's part of the scalp";
}

TEST(PlanHairs, RefusesWhatMakesNoSense) {
  const auto rests = restsOf(headOf(3));
  const auto refusal = [&](const FollowOptions& options) {
    return planHairs(rests, options).error().message;
  };
  EXPECT_EQ(refusal({.hairCount = 0}), "the number of hairs is 0; it must be between 1 and 10000000");
  EXPECT_EQ(refusal({.reach = 0}).find("the reach of hairs [m] is 0;"), 0u);
  EXPECT_EQ(refusal({.phase = -1}).find("the largest turn of a hair's curl is -1;"), 0u);
  EXPECT_EQ(refusal({.radius = 1}).find("the variation of the curl radius is 1;"), 0u);
  EXPECT_EQ(refusal({.length = std::nan("")}).find("the variation of the length is nan;"), 0u);
  EXPECT_EQ(refusal({.gather = 2}).find("the share by which hairs gather is 2;"), 0u);
  EXPECT_EQ(refusal({.strayShare = -0.1}).find("the share of strays is -0.1;"), 0u);
  EXPECT_EQ(refusal({.frizz = 11}).find("the frizz of hairs is 11;"), 0u);
  EXPECT_EQ(planHairs({}, {}).error().message, "there is no guide that hairs could follow");
}

}  // namespace
}  // namespace ringlet::follow_hairs_test
