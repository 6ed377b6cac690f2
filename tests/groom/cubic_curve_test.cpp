// groom/cubic_curve.h: closed forms of each basis, ends, and the tolerance.
#include "ringlet/groom/cubic_curve.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ringlet/groom/usd/usd_file.h"
#include "tests/groom/groom_samples.h"
#include "tests/groom/usda_samples.h"

namespace ringlet::cubic_curve_test {
namespace {

std::vector<Vec3d> particlesOf(const std::vector<Vec3d>& points, CubicBasis basis, bool isPinned = false) {
  std::vector<Vec3d> particles;
  appendCubic(points, basis, isPinned, particles);
  return particles;
}
double lengthOf(const std::vector<Vec3d>& particles) {
  double sum = 0;
  for (std::size_t i = 1; i < particles.size(); ++i) sum += length(particles[i] - particles[i - 1]);
  return sum;
}

// Control points of a Bezier curve that follows a circle of radius 1, a quarter a piece, within 2.7e-4.
std::vector<Vec3d> circle(int quarters) {
  const double k = 4.0 / 3 * (std::sqrt(2) - 1);
  std::vector<Vec3d> points{{1, 0, 0}};
  for (int q = 0; q < quarters; ++q) {
    const double a = q * std::numbers::pi / 2, b = a + std::numbers::pi / 2;
    const Vec3d from{std::cos(a), std::sin(a), 0}, to{std::cos(b), std::sin(b), 0};
    points.push_back(from + Vec3d{-from.y, from.x, 0} * k);
    points.push_back(to - Vec3d{-to.y, to.x, 0} * k);
    points.push_back(to);
  }
  return points;
}

TEST(CubicCurve, ABezierArcStaysWithinTheTolerance) {
  for (const int quarters : {1, 2, 3, 7}) {
    const auto particles = particlesOf(circle(quarters), CubicBasis::bezier);
    const double arc = quarters * std::numbers::pi / 2;
    EXPECT_NEAR(lengthOf(particles), arc, 3e-3 * arc);
    // How far the middle of an edge is from the circle: at most the tolerance, and not a hundredth of it.
    double farthest = 0;
    for (std::size_t i = 0; i < particles.size(); ++i) {
      EXPECT_NEAR(length(particles[i]), 1, 2.8e-4);
      if (i > 0) farthest = std::max(farthest, 1 - length((particles[i] + particles[i - 1]) / 2));
    }
    EXPECT_LT(farthest, kCubicTolerance * arc * 1.05);
    EXPECT_GT(farthest, kCubicTolerance * arc / 10);
    EXPECT_EQ(particles.front(), (Vec3d{1, 0, 0}));
    EXPECT_EQ(particles.back(), circle(quarters).back());
  }
}

TEST(CubicCurve, PiecesHaveAsManyEdges) {
  // The middle of a curve of two pieces is their common point, however it is bent.
  std::vector<Vec3d> points{{0, 0, 0}, {0, 1, 0}, {0, 2, 0}, {0, 3, 0}, {5, 3, 0}, {5, 8, 0}, {0, 9, 2}};
  const auto particles = particlesOf(points, CubicBasis::bezier);
  ASSERT_EQ(particles.size() % 2, 1u);
  EXPECT_EQ(particles[particles.size() / 2], points[3]);
  EXPECT_GT(particles.size(), 9u);
  EXPECT_LE(particles.size(), 2 * 28u + 1);
  // Straight and evenly spaced: an edge a piece.
  EXPECT_EQ(particlesOf({{0, 0, 0}, {0, 1, 0}, {0, 2, 0}, {0, 3, 0}}, CubicBasis::bezier).size(), 2u);
}

TEST(CubicCurve, BSplinesReachTheirEndsOnlyPinned) {
  const std::vector<Vec3d> points{{0, 0, 0}, {1, 3, 0}, {2, -1, 4}, {5, 2, 2}, {6, 6, 6}};
  const auto loose = particlesOf(points, CubicBasis::bspline);
  EXPECT_LT(length(loose.front() - (points[0] + points[1] * 4 + points[2]) / 6), 1e-15);
  EXPECT_LT(length(loose.back() - (points[2] + points[3] * 4 + points[4]) / 6), 1e-15);
  const auto pinned = particlesOf(points, CubicBasis::bspline, true);
  EXPECT_LT(length(pinned.front() - points.front()), 1e-15);
  EXPECT_LT(length(pinned.back() - points.back()), 1e-14);
  // In between it is the same curve: both go through the point where the second piece begins.
  EXPECT_GT(pinned.size(), loose.size());
  // Of points on a line at equal distances it is that line, with the same speed.
  std::vector<Vec3d> line;
  for (int i = 0; i < 6; ++i) line.push_back({double(i), 0, 0});
  const auto straight = particlesOf(line, CubicBasis::bspline);
  ASSERT_EQ(straight.size(), 4u);
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(straight[std::size_t(i)].x, i + 1, 1e-14);
}

TEST(CubicCurve, CatmullRomGoesThroughItsPoints) {
  const std::vector<Vec3d> points{{0, 0, 0}, {1, 3, 0}, {2, -1, 4}, {5, 2, 2}, {6, 6, 6}};
  for (const bool isPinned : {false, true}) {
    const auto particles = particlesOf(points, CubicBasis::catmullRom, isPinned);
    const std::size_t pieces = isPinned ? 4 : 2, first = isPinned ? 0 : 1;
    ASSERT_EQ((particles.size() - 1) % pieces, 0u);
    const std::size_t edges = (particles.size() - 1) / pieces;
    for (std::size_t k = 0; k <= pieces; ++k) EXPECT_EQ(particles[k * edges], points[first + k]);
    // Its direction at a point is that from the one before to the one after.
    if (isPinned) {
      const Vec3d along = points[2] - points[0], before = particles[edges] - particles[edges - 1],
                  after = particles[edges + 1] - particles[edges];
      const Vec3d way = normalizedOr(before, {}) + normalizedOr(after, {});
      EXPECT_GT(dot(normalizedOr(way, {}), normalizedOr(along, {})), 0.99);
    }
  }
}

TEST(CubicCurve, CountsThatMakeACurve) {
  for (std::size_t n = 0; n < 20; ++n) {
    EXPECT_EQ(isCubicCount(CubicBasis::bezier, false, n),
              n == 4 || n == 7 || n == 10 || n == 13 || n == 16 || n == 19);
    EXPECT_EQ(isCubicCount(CubicBasis::bezier, true, n), isCubicCount(CubicBasis::bezier, false, n));
    for (const auto basis : {CubicBasis::bspline, CubicBasis::catmullRom}) {
      EXPECT_EQ(isCubicCount(basis, false, n), n >= 4);
      EXPECT_EQ(isCubicCount(basis, true, n), n >= 2);
    }
  }
  // A pinned curve of two points is the line between them.
  const auto line = particlesOf({{1, 2, 3}, {4, 5, 6}}, CubicBasis::catmullRom, true);
  EXPECT_EQ(line, (std::vector<Vec3d>{{1, 2, 3}, {4, 5, 6}}));
}

TEST(CubicCurve, SharpBendsCostNoMoreThanTheirBound) {
  // There and back: as bent as can be.
  for (const double size : {1e-30, 1.0, 1e30}) {
    const auto particles =
        particlesOf({{0, 0, 0}, {size, 0, 0}, {0, 0, 0}, {size, 0, 0}}, CubicBasis::bezier);
    EXPECT_LE(particles.size(), 29u);
  }
  EXPECT_EQ(particlesOf(std::vector<Vec3d>(7, Vec3d{1, 2, 3}), CubicBasis::bezier).size(), 3u);
}

// As many edges from either end, however long the sides are: each counts.
TEST(CubicCurve, TurnedAroundItIsTheSameCurve) {
  for (const CubicBasis basis : {CubicBasis::bezier, CubicBasis::bspline, CubicBasis::catmullRom}) {
    for (std::vector<Vec3d> points : {std::vector<Vec3d>{{0, 0, 0}, {0.1, 0, 0}, {0.2, 0.1, 0}, {3, 9, 0}},
                                      {{0, 0, 0}, {5, 0, 1}, {5, 0.1, 1}, {5.1, 0.2, 1}}}) {
      const std::vector<Vec3d> forth = particlesOf(points, basis);
      std::ranges::reverse(points);
      std::vector<Vec3d> back = particlesOf(points, basis);
      std::ranges::reverse(back);
      ASSERT_EQ(forth.size(), back.size());
      for (std::size_t i = 0; i < forth.size(); ++i) EXPECT_LT(length(forth[i] - back[i]), 1e-13);
    }
  }
}

TEST(CubicCurve, AFilesTokensChooseTheBasis) {
  const std::string points =
      "int[] curveVertexCounts = [5] point3f[] points = [(0,0,0),(1,3,0),(2,-1,4),(5,2,2),(6,6,6)] ";
  const auto firstOf = [&](const std::string& tokens) {
    const auto loaded = readUsd(test::bytesOf(test::curves(points + tokens)), "test.usda");
    EXPECT_TRUE(loaded) << loaded.error().message;
    return loaded ? loaded->groom.points.front() : Vec3f{};
  };
  EXPECT_EQ(firstOf("uniform token basis = \"catmullRom\""), (Vec3f{1, 3, 0}));
  EXPECT_EQ(firstOf("uniform token basis = \"catmullRom\" uniform token wrap = \"pinned\""),
            (Vec3f{0, 0, 0}));
  EXPECT_LT(length(firstOf("uniform token basis = \"bspline\"") - Vec3f{1, 11.f / 6, 4.f / 6}), 1e-6f);
  EXPECT_EQ(firstOf("uniform token basis = \"bspline\" uniform token wrap = \"pinned\""), (Vec3f{0, 0, 0}));
  EXPECT_EQ(firstOf("uniform token type = \"linear\""), (Vec3f{0, 0, 0}));
  // Without any it is a Bezier curve, which five points do not make.
  const auto none = readUsd(test::bytesOf(test::curves(points)), "test.usda");
  ASSERT_FALSE(none);
  EXPECT_TRUE(test::contains(none.error().message, "1 curve have too few points") ||
              test::contains(none.error().message, "too few points"));
}

// By the definition of B-splines: the sum of points times their functions of Cox and de Boor.
double basisOf(const std::vector<double>& knots, std::size_t i, int degree, double t) {
  if (degree == 0) return knots[i] <= t && t < knots[i + 1] ? 1 : 0;
  const auto d = static_cast<std::size_t>(degree);
  const double rise = knots[i + d] - knots[i], fall = knots[i + d + 1] - knots[i + 1];
  double sum = 0;
  if (rise > 0) sum += (t - knots[i]) / rise * basisOf(knots, i, degree - 1, t);
  if (fall > 0) sum += (knots[i + d + 1] - t) / fall * basisOf(knots, i + 1, degree - 1, t);
  return sum;
}

TEST(CubicCurve, ABSplineWithKnotsIsABezierCurve) {
  const std::vector<std::vector<double>> cases{{0, 0, 0, 0, 1, 1, 1, 1},
                                               {0, 1, 2, 3, 4, 5, 6, 7, 8},
                                               {0, 0, 0, 0, 1, 2, 2, 2, 2},
                                               {-3, -3, -3, -3, -1, 0, 0, 0.25, 4, 4, 4, 4},
                                               {0, 0, 1, 3, 3, 3, 7, 8, 8.5, 9, 11, 11.5}};
  for (const std::vector<double>& knots : cases) {
    const std::size_t count = knots.size() - 4;
    std::vector<Vec3d> points, bezier;
    for (std::size_t i = 0; i < count; ++i) {
      const auto x = static_cast<double>(i);
      points.push_back({std::cos(2 * x), x * x, std::sin(3 * x)});
    }
    ASSERT_TRUE(areCubicKnots(knots, count));
    appendBezierOfKnots(points, knots, bezier);
    std::size_t piece = 0;
    for (std::size_t k = 3; k < count; ++k) {
      if (!(knots[k] < knots[k + 1])) continue;
      ASSERT_LE(3 * piece + 4, bezier.size());
      const Vec3d* b = &bezier[3 * piece++];
      for (const double u : {0.0, 0.3, 0.5, 0.9}) {
        const double v = 1 - u, t = knots[k] * v + knots[k + 1] * u;
        Vec3d expected{};
        for (std::size_t i = 0; i < count; ++i) expected = expected + points[i] * basisOf(knots, i, 3, t);
        const Vec3d found =
            b[0] * (v * v * v) + b[1] * (3 * v * v * u) + b[2] * (3 * v * u * u) + b[3] * (u * u * u);
        EXPECT_LE(length(found - expected), 1e-12) << "span " << k << " at " << u;
      }
    }
    EXPECT_EQ(bezier.size(), 3 * piece + 1);
  }
  EXPECT_FALSE(areCubicKnots(std::vector<double>{0, 0, 0, 0, 0, 0, 0, 0}, 4));
  EXPECT_FALSE(areCubicKnots(std::vector<double>{0, 0, 0, 1, 1, 1, 1}, 3));
  EXPECT_FALSE(areCubicKnots(std::vector<double>{0, 0, 0, 0, 1, 1, 1, 1}, 5));
  EXPECT_FALSE(areCubicKnots(std::vector<double>{0, 0, 0, 2, 1, 3, 3, 3}, 4));
  EXPECT_FALSE(areCubicKnots(std::vector<double>{0, 0, 0, 0, 1, 1, 1, std::nan("")}, 4));
}

}  // namespace
}  // namespace ringlet::cubic_curve_test
