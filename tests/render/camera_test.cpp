// Where a camera stands, and what it shows.
#include "ringlet/render/camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace ringlet::camera_test {
namespace {

// Across and up, as shares of the picture's half.
std::pair<double, double> inPicture(const Camera& camera, double aspect, Vec3d point) {
  const CameraAxes axes = axesOf(camera);
  const Vec3d at = point - camera.eye;
  const double depth = dot(at, axes.forward) * std::tan(camera.fieldOfView / 2);
  EXPECT_GT(depth, 0);
  return {dot(at, axes.right) / (depth * aspect), dot(at, axes.up) / depth};
}

std::vector<Vec3d> cloud(int count) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  std::vector<Vec3d> points;
  for (int i = 0; i < count; ++i)
    points.push_back({0.3 * normal(random) + 5, normal(random), 0.1 * normal(random) - 2});
  return points;
}

TEST(Camera, AxesAreRightHandedAndSeeTheTarget) {
  const Camera camera{.eye = {1, 2, 3}, .target = {0.5, 1, -1}};
  const CameraAxes axes = axesOf(camera);
  EXPECT_NEAR(dot(axes.right, axes.up), 0, 1e-15);
  EXPECT_LT(length(cross(axes.right, axes.up) + axes.forward), 1e-15);
  EXPECT_GT(axes.up.y, 0);
  EXPECT_LT(length(cross(axes.forward, camera.target - camera.eye)), 1e-15);
}

TEST(Camera, ShowsAllPointsAndNoMoreThanItMust) {
  const std::vector<Vec3d> points = cloud(500);
  for (const Vec3d up : {Vec3d{0, 1, 0}, Vec3d{0, 0, 1}}) {
    for (const double aspect : {0.5, 1.0, 16.0 / 9}) {
      for (const double azimuth : {0.0, 0.6, 3.0}) {
        const Camera camera = cameraAround(points, up, aspect, {.azimuth = azimuth, .elevation = 0.4});
        double widest = 0;
        for (const Vec3d& point : points) {
          const auto [across, high] = inPicture(camera, aspect, point);
          widest = std::max({widest, std::abs(across), std::abs(high)});
        }
        EXPECT_NEAR(widest, 0.9, 1e-9) << aspect << " " << azimuth;
      }
    }
  }
}

TEST(Camera, TheFrontIsPlusZOrMinusYWhereZIsUp) {
  const std::vector<Vec3d> points = {{-1, -1, -1}, {1, 1, 1}};
  const CameraPlace front{.azimuth = 0, .elevation = 0},
      right{.azimuth = std::numbers::pi / 2, .elevation = 0};
  EXPECT_GT(cameraAround(points, {0, 1, 0}, 1, front).eye.z, 1);
  EXPECT_GT(cameraAround(points, {0, 1, 0}, 1, right).eye.x, 1);
  EXPECT_LT(cameraAround(points, {0, 0, 1}, 1, front).eye.y, -1);
  EXPECT_GT(cameraAround(points, {0, 0, 1}, 1, right).eye.x, 1);
  EXPECT_GT(cameraAround(points, {0, 1, 0}, 1, {.azimuth = 0, .elevation = 1}).eye.y, 1);
}

TEST(Camera, DistanceIsAFactor) {
  const std::vector<Vec3d> points = cloud(20);
  const Camera near = cameraAround(points, {0, 1, 0}, 1, {}),
               far = cameraAround(points, {0, 1, 0}, 1, {.distance = 3});
  EXPECT_NEAR(length(far.eye - far.target), 3 * length(near.eye - near.target), 1e-12);
}

TEST(Camera, AnOutlineShowsNearlyAll) {
  const std::vector<Vec3d> points = cloud(2000);
  Outline outline;
  for (const Vec3d& point : points) outline.add(point);
  EXPECT_EQ(outline.points().size(), 26u);
  for (const double azimuth : {0.0, 0.7, 2.0}) {
    const Camera camera =
        cameraAround(outline.points(), {0, 1, 0}, 1.5, {.azimuth = azimuth, .elevation = 0.3});
    for (const Vec3d& point : points) {
      const auto [across, high] = inPicture(camera, 1.5, point);
      EXPECT_LT(std::max(std::abs(across), std::abs(high)), 1);
    }
  }
  Outline one;
  one.add({1, 2, 3});
  EXPECT_EQ(one.points().front(), (Vec3d{1, 2, 3}));
}

}  // namespace
}  // namespace ringlet::camera_test
