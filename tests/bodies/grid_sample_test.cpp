// bodies/grid_sample.h and shape_grid.h: what trilinear interpolation has exactly, its gradient against
// finite differences, and distances beyond the grid that are never too large.
#include "ringlet/bodies/grid_sample.h"

#include <gtest/gtest.h>

#include <cmath>

#include "ringlet/bodies/shape_grid.h"
#include "tests/bodies/body_samples.h"

namespace ringlet::grid_sample_test {
namespace {

const Bounds kRoom{{-0.15, -0.14, -0.16}, {0.15, 0.16, 0.14}};

TEST(ShapeGrid, CoversItsBounds) {
  const DistanceGrid grid = sampleDistance([](Vec3d p) { return p.x; }, {{0, 0, 0}, {0.3, 0.25, 0}}, 0.1);
  EXPECT_EQ(grid.counts, (std::array<std::uint32_t, 3>{3, 3, 1}));
  EXPECT_EQ(grid.distances.size(), 4u * 4 * 2);
  EXPECT_EQ(grid.distances[grid.cornerIndex(2, 1, 1)], 0.2f);
}

TEST(GridSample, HasPlanesExactly) {
  const Vec3d normal = normalizedOr(Vec3d{1, -2, 0.5}, Vec3d{});
  const DistanceGrid grid = sampleDistance([&](Vec3d p) { return dot(p, normal) - 0.02; }, kRoom, 0.01);
  test::Places places(1, kRoom.low, kRoom.high);
  for (int i = 0; i < 2000; ++i) {
    const Vec3d p = places.next();
    const GridSample sample = sampleGrid(grid, p);
    ASSERT_NEAR(sample.distance, dot(p, normal) - 0.02, 2e-8);  // the grid holds floats
    ASSERT_LT(length(sample.direction - normal), 1e-5);
  }
}

TEST(GridSample, HasCornersExactly) {
  const DistanceGrid grid = sampleDistance([](Vec3d p) { return test::sphereDistance(p, 0.1); }, kRoom, 0.02);
  for (std::uint32_t z = 0; z <= grid.counts[2]; ++z) {
    for (std::uint32_t y = 0; y <= grid.counts[1]; ++y) {
      for (std::uint32_t x = 0; x <= grid.counts[0]; ++x) {
        const Vec3d p = grid.origin + Vec3d{double(x), double(y), double(z)} * grid.cell;
        ASSERT_NEAR(sampleGrid(grid, p).distance, double{grid.distances[grid.cornerIndex(x, y, z)]}, 1e-9);
      }
    }
  }
}

TEST(GridSample, DirectionIsTheGradientWithin) {
  const DistanceGrid grid =
      sampleDistance([](Vec3d p) { return test::torusDistance(p, 0.08, 0.03); }, kRoom, 0.01);
  test::Places places(2, kRoom.low, kRoom.high);
  constexpr double kStep = 1e-7;
  int count = 0;
  for (int i = 0; i < 5000; ++i) {
    const Vec3d p = places.next();
    // Within one cell: the gradient jumps from cell to cell.
    const Vec3d at = (p - grid.origin) / grid.cell;
    auto isClear = [](double x) { return x - std::floor(x) > 0.01 && x - std::floor(x) < 0.99; };
    if (!isClear(at.x) || !isClear(at.y) || !isClear(at.z)) continue;
    auto slope = [&](Vec3d step) {
      return (sampleGrid(grid, p + step).distance - sampleGrid(grid, p - step).distance) / (2 * kStep);
    };
    const Vec3d gradient{slope({kStep, 0, 0}), slope({0, kStep, 0}), slope({0, 0, kStep})};
    if (length(gradient) < 0.1) continue;  // on the torus's own axis it has no direction
    ASSERT_LT(length(sampleGrid(grid, p).direction - normalizedOr(gradient, Vec3d{})), 1e-6) << i;
    ++count;
  }
  EXPECT_GT(count, 4000);
}

TEST(GridSample, IsNeverTooFarOutside) {
  const Vec3d half{0.08, 0.05, 0.11};
  // Interpolation of a convex distance errs upwards, by the second differences of a cell at most.
  const auto expectBound = [&](const DistanceGrid& grid, auto&& distance, double slack) {
    test::Places places(3, {-0.6, -0.6, -0.6}, {0.6, 0.6, 0.6});
    for (int i = 0; i < 5000; ++i) {
      const Vec3d p = places.next();
      const GridSample sample = sampleGrid(grid, p);
      ASSERT_LE(sample.distance, distance(p) + slack) << p.x << ' ' << p.y << ' ' << p.z;
      ASSERT_NEAR(length(sample.direction), 1, 1e-12);
      const Vec3d clamped{std::clamp(p.x, kRoom.low.x, kRoom.high.x),
                          std::clamp(p.y, kRoom.low.y, kRoom.high.y),
                          std::clamp(p.z, kRoom.low.z, kRoom.high.z)};
      if (clamped == p) continue;
      ASSERT_GE(sample.distance, length(p - clamped));
      ASSERT_GT(dot(sample.direction, p - clamped), 0);
    }
  };
  const auto box = [&](Vec3d p) { return test::boxDistance(p, half); };
  const auto sphere = [](Vec3d p) { return test::sphereDistance(p, 0.1); };
  expectBound(sampleDistance(box, kRoom, 0.01), box, 0.005);
  expectBound(sampleDistance(sphere, kRoom, 0.01), sphere, 0.005);
}

TEST(GridSample, IsContinuousAcrossItsBorder) {
  const DistanceGrid grid = sampleDistance([](Vec3d p) { return test::sphereDistance(p, 0.1); }, kRoom, 0.01);
  test::Places places(4, kRoom.low, kRoom.high);
  for (int i = 0; i < 1000; ++i) {
    Vec3d p = places.next();
    p.y = kRoom.high.y;
    const double in = sampleGrid(grid, p - Vec3d{0, 1e-9, 0}).distance;
    const double out = sampleGrid(grid, p + Vec3d{0, 1e-9, 0}).distance;
    ASSERT_NEAR(in, out, 1e-8);
  }
}

TEST(GridSample, PointsUpWhereThereIsNoGradient) {
  const DistanceGrid grid = sampleDistance([](Vec3d) { return 0.01; }, kRoom, 0.1);
  EXPECT_EQ(sampleGrid(grid, {0.01, 0.02, 0.03}).direction, (Vec3d{0, 1, 0}));
  const DistanceGrid sunk = sampleDistance([](Vec3d) { return -0.01; }, kRoom, 0.1);
  EXPECT_EQ(sampleGrid(sunk, {0.01, 0.02, 0.03}).distance, double{-0.01f});
  EXPECT_EQ(sampleGrid(sunk, {1, 0, 0}).direction, (Vec3d{1, 0, 0}));
}

}  // namespace
}  // namespace ringlet::grid_sample_test
