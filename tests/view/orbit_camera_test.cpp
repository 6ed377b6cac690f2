// The camera that the mouse moves, and what lies under the mouse.
#include "view/orbit_camera.h"

#include <gtest/gtest.h>

#include <numbers>

#include "ringlet/bodies/icosphere.h"

namespace ringlet::view::orbit_camera_test {
namespace {

const std::vector<Vec3d> kPoints{{-0.2, -0.4, -0.2}, {0.2, 0.2, 0.2}};

TEST(OrbitCamera, GoesAroundItsTargetAndHome) {
  for (const Vec3d up : {Vec3d{0, 1, 0}, Vec3d{0, 0, 1}}) {
    OrbitCamera camera(kPoints, up, 1.5);
    const Camera first = camera.camera();
    const double distance = length(first.eye - first.target);
    camera.orbit(0.7, 0.3);
    EXPECT_EQ(camera.camera().target, first.target);
    EXPECT_NEAR(length(camera.camera().eye - first.target), distance, 1e-12);
    EXPECT_GT(dot(camera.camera().eye - first.eye, up), 0.1 * distance) << "up";
    camera.orbit(-0.7, -0.3);
    EXPECT_LT(length(camera.camera().eye - first.eye), 1e-9);
    camera.orbit(2 * std::numbers::pi, 0);
    EXPECT_LT(length(camera.camera().eye - first.eye), 1e-9) << "once around";
    camera.orbit(0, 100);
    EXPECT_LT(length(cross(normalizedOr(camera.camera().eye - first.target, up), up)), 0.03) << "to the pole";
    EXPECT_GT(length(cross(camera.camera().eye - first.target, up)), 0) << "and not beyond";
    camera.home();
    EXPECT_EQ(camera.camera().eye, first.eye);
  }
}

TEST(OrbitCamera, PansByPixelsAndZoomsByFactors) {
  OrbitCamera camera(kPoints, {0, 1, 0}, 1.5);
  const Vec3d target = camera.camera().target;
  const auto before = *camera.project(target, 600, 400);
  EXPECT_NEAR(before.x, 300, 1e-9);
  EXPECT_NEAR(before.y, 200, 1e-9);
  camera.pan(30, -20, 400);
  const auto after = *camera.project(target, 600, 400);
  EXPECT_NEAR(after.x, 330, 1e-6);
  EXPECT_NEAR(after.y, 180, 1e-6);
  const double distance = length(camera.camera().eye - camera.camera().target);
  camera.zoom(0.5);
  EXPECT_NEAR(length(camera.camera().eye - camera.camera().target), distance / 2, 1e-12);
  camera.zoom(1e-9);
  EXPECT_GT(length(camera.camera().eye - camera.camera().target), 0.01);
}

TEST(OrbitCamera, RaysGoThroughWhatIsSeenThere) {
  OrbitCamera camera(kPoints, {0, 1, 0}, 1.5);
  camera.orbit(0.4, 0.2);
  for (const Vec3d place : {Vec3d{0.1, -0.2, 0.05}, Vec3d{-0.15, 0.1, 0.2}}) {
    const auto at = *camera.project(place, 600, 400);
    const Ray ray = camera.rayThrough(at.x / 600, at.y / 400, 1.5);
    EXPECT_LT(length(cross(place - ray.from, ray.along)), 1e-9);
    EXPECT_NEAR(length(ray.along), 1, 1e-12);
    EXPECT_GT(dot(place - ray.from, ray.along), 0);
    // What is dragged goes with the mouse.
    const auto moved = *camera.project(place + camera.moveOf(place, 7, 11, 400), 600, 400);
    EXPECT_NEAR(moved.x, at.x + 7, 1e-6);
    EXPECT_NEAR(moved.y, at.y + 11, 1e-6);
  }
  EXPECT_FALSE(camera.project(camera.camera().eye * 2.0 - camera.camera().target, 600, 400)) << "behind it";
}

TEST(OrbitCamera, TheNearestSolidIsHit) {
  TriangleMesh ball = makeIcosphere(8);
  for (Vec3d& p : ball.points) p = p * 0.1;
  const std::vector<SolidMesh> solids{solidMeshOf(ball), solidMeshOf(ball)};
  const std::vector<SolidPlace> places{{{0, 0, -1}, {}}, {{0.05, 0, 0}, {}}};
  const auto hit = hitBy({{0, 0, 2}, {0, 0, -1}}, solids, places);
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->solid, 1u);
  EXPECT_NEAR(length(hit->place - places[1].position), 0.1, 0.002);
  EXPECT_NEAR(hit->place.x, 0, 1e-9);
  const auto behind = hitBy({{-0.07, 0, 2}, {0, 0, -1}}, solids, places);
  ASSERT_TRUE(behind);
  EXPECT_EQ(behind->solid, 0u);
  EXPECT_FALSE(hitBy({{0.5, 0, 2}, {0, 0, -1}}, solids, places));
  EXPECT_FALSE(hitBy({{0, 0, 2}, {0, 0, 1}}, solids, places)) << "behind the eye";
}

// A ball 0.3 m along its solid's X axis, which points along -Z once the solid is turned.
TEST(OrbitCamera, SolidsAreHitWhereTheyAreTurned) {
  TriangleMesh ball = makeIcosphere(8);
  for (Vec3d& p : ball.points) p = p * 0.1 + Vec3d{0.3, 0, 0};
  const std::vector<SolidMesh> solids{solidMeshOf(ball)};
  const std::vector<SolidPlace> places{{{0, 1, 0}, fromRotationVector(Vec3d{0, std::numbers::pi / 2, 0})}};
  const auto hit = hitBy({{2, 1, -0.3}, {-1, 0, 0}}, solids, places);
  ASSERT_TRUE(hit);
  EXPECT_NEAR(length(hit->place - Vec3d{0.1, 1, -0.3}), 0, 0.002);
  for (const Vec3d elsewhere : {Vec3d{2, 1, 0.3}, Vec3d{2, 1, 0}, Vec3d{2, 0, -0.3}})
    EXPECT_FALSE(hitBy({elsewhere, {-1, 0, 0}}, solids, places));
}

}  // namespace
}  // namespace ringlet::view::orbit_camera_test
