// Which strands are picked as guides.
#include "ringlet/follow/pick_guides.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <span>
#include <vector>

#include "ringlet/groom/generate.h"

namespace ringlet::test::pick_guides_test {
namespace {

std::vector<RestShape> shapesOf(const Groom& groom) {
  std::vector<RestShape> shapes;
  for (std::size_t s = 0; s < groom.strandCount(); ++s) {
    std::vector<Vec3d> points;
    for (const Vec3f& p : groom.strand(s)) points.push_back(Vec3d(p) * groom.metresPerUnit);
    const GuideRest rest = restOfGuide(points);
    shapes.push_back(restShapeOf(std::move(points), rest));
  }
  return shapes;
}

std::vector<Groom> grooms() {
  std::vector<Groom> all;
  for (const int locks : {0, 20})
    all.push_back(*makeHead({.curl = {.particleCount = 16}, .strandCount = 300, .lockCount = locks}));
  return all;
}

// Mean square distance of strands from the guide that each is most like.
double meanApart(const StrandTraits& strands, const std::vector<std::uint32_t>& guides) {
  double sum = 0;
  for (std::size_t s = 0; s < strands.count(); ++s) {
    double least = std::numeric_limits<double>::infinity();
    for (const std::uint32_t g : guides) least = std::min(least, strands.apart(s, g));
    sum += least;
  }
  return sum / double(strands.count());
}

TEST(PickGuides, AreSoManyAndRise) {
  for (const Groom& groom : grooms()) {
    const StrandTraits strands(shapesOf(groom));
    for (const std::size_t count : {1u, 2u, 30u, 299u, 300u, 500u}) {
      const auto guides = pickGuides(strands, count);
      EXPECT_EQ(guides.size(), std::min<std::size_t>(count, 300));
      EXPECT_EQ(std::set(guides.begin(), guides.end()).size(), guides.size());
      EXPECT_TRUE(std::ranges::is_sorted(guides));
      EXPECT_LT(guides.back(), 300u);
      EXPECT_EQ(pickGuides(strands, count), guides) << "a second time";
    }
  }
}

TEST(PickGuides, AreNearerThanGuidesPickedAtRandom) {
  std::mt19937 random(1);
  for (const Groom& groom : grooms()) {
    const StrandTraits strands(shapesOf(groom));
    for (const std::size_t count : {5u, 30u, 100u}) {
      const double picked = meanApart(strands, pickGuides(strands, count));
      double best = std::numeric_limits<double>::infinity();
      for (int k = 0; k < 20; ++k) {
        std::vector<std::uint32_t> all(300), some;
        for (std::uint32_t s = 0; s < 300; ++s) all[s] = s;
        std::ranges::sample(all, std::back_inserter(some), std::ptrdiff_t(count), random);
        best = std::min(best, meanApart(strands, some));
      }
      EXPECT_LT(picked, 0.8 * best) << count;
    }
  }
}

TEST(PickGuides, PointsInOnePlaceDoNotCount) {
  for (Groom groom : grooms()) {
    const StrandTraits whole(shapesOf(groom));
    Groom still = groom;
    for (std::size_t s = 0; s < groom.strandCount(); ++s) {
      const auto points = std::span(still.points).subspan(still.firstPoint[s], groom.strand(s).size());
      points[1] = points[0];
      points[15] = points[14];
    }
    const StrandTraits strands(shapesOf(still));
    for (std::size_t s = 1; s < strands.count(); ++s) {
      const double apart = strands.apart(0, s);
      EXPECT_NEAR(std::sqrt(apart), std::sqrt(whole.apart(0, s)), 0.02) << s;
    }
  }
}

// A strand unlike all others has no other to follow.
TEST(PickGuides, StraysLeadThemselves) {
  for (Groom groom : grooms()) {
    std::set<std::uint32_t> strays;
    for (const std::uint32_t s : {7u, 120u, 251u}) {
      std::vector<Vec3f> strand(groom.strand(s).begin(), groom.strand(s).end());
      for (Vec3f& p : strand)
        p = strand.front() + Vec3f{0, 1, 0} * length(p - strand.front()) * (1 + 0.2f * float(s % 3));
      std::ranges::copy(strand, groom.points.begin() + groom.firstPoint[s]);
      strays.insert(s);
    }
    const auto guides = pickGuides(StrandTraits(shapesOf(groom)), 40);
    EXPECT_TRUE(std::ranges::includes(guides, strays));
  }
}

}  // namespace
}  // namespace ringlet::test::pick_guides_test
