// reference/equations/triangle_distance.h against a search over the triangle.
#include "reference/equations/triangle_distance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace ringlet::reference {
namespace {

using Vector = Vector3<double>;

// Of all places of a fine lattice on the triangle.
double searched(const Vector& p, const Vector& a, const Vector& b, const Vector& c) {
  constexpr int kParts = 400;
  double least = 1e300;
  for (int i = 0; i <= kParts; ++i)
    for (int j = 0; i + j <= kParts; ++j)
      least = std::min(least, (p - a - (b - a) * i / kParts - (c - a) * j / kParts).norm());
  return least;
}

TEST(TriangleDistance, IsTheLeastOfAllPlaces) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(-1, 1);
  const auto any = [&] { return Vector(place(random), place(random), place(random)); };
  for (int i = 0; i < 40; ++i) {
    const Vector a = any(), b = any(), c = any(), p = 2 * any();
    const double size = std::max({(b - a).norm(), (c - a).norm(), (c - b).norm()});
    EXPECT_NEAR(triangleDistance<double>(p, a, b, c), searched(p, a, b, c), size / 200);
    EXPECT_LE(triangleDistance<double>(p, a, b, c), searched(p, a, b, c) + 1e-12);
  }
}

TEST(TriangleDistance, SharesAreOfTheNearestPlace) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> place(-1, 1);
  const auto any = [&] { return Vector(place(random), place(random), place(random)); };
  for (int i = 0; i < 400; ++i) {
    const Vector a = any(), b = any(), c = i % 20 == 0 ? Vector(a + 0.3 * (b - a)) : any(), p = 2 * any();
    const Vector shares = nearestShares<double>(p, a, b, c);
    EXPECT_NEAR(shares.sum(), 1, 1e-12);
    EXPECT_GE(shares.minCoeff(), -1e-12);
    EXPECT_NEAR((p - shares[0] * a - shares[1] * b - shares[2] * c).norm(),
                triangleDistance<double>(p, a, b, c), 1e-9);
  }
}

TEST(TriangleDistance, TakesTrianglesWithoutArea) {
  const Vector a(0, 0, 0), b(1, 0, 0), p(0.5, 2, 0), beyond(4, 4, 0);
  EXPECT_DOUBLE_EQ(triangleDistance<double>(p, a, b, b), 2);
  EXPECT_DOUBLE_EQ(triangleDistance<double>(p, a, b, Vector(0.3, 0, 0)), 2);
  EXPECT_DOUBLE_EQ(triangleDistance<double>(beyond, a, b, a), 5);
  EXPECT_DOUBLE_EQ(triangleDistance<double>(p, a, a, a), p.norm());
}

}  // namespace
}  // namespace ringlet::reference
