// motion/bust_motion.h: it nods and shrugs as much as it says, from rest to rest, and never turns inside out.
#include "ringlet/motion/bust_motion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <span>
#include <vector>

#include "ringlet/base/bounds.h"
#include "ringlet/bodies/bust_mesh.h"
#include "ringlet/bodies/triangle_mesh.h"
#include "ringlet/bodies/triangle_tree.h"
#include "ringlet/measure/head_fit.h"

namespace ringlet::bust_motion_test {
namespace {

constexpr double kFrame = 1 / 24.0;

double farthest(std::span<const Vec3d> a, std::span<const Vec3d> b) {
  double far = 0;
  for (std::size_t i = 0; i < a.size(); ++i) far = std::max(far, length(a[i] - b[i]));
  return far;
}

double volumeOf(const std::vector<Vec3d>& points, const MeshMotion& mesh) {
  double six = 0;
  for (const auto& [a, b, c] : mesh.triangles()) six += dot(points[a], cross(points[b], points[c]));
  return six / 6;
}

TEST(BustMotion, GoesFromRestToRestWithoutAJolt) {
  const auto bust = generatedMotion("bust");
  const std::vector<Vec3d> rest = makeBustMesh().points;
  const double end = bust->lastSeconds();
  EXPECT_EQ(bust->firstSeconds(), 0);
  EXPECT_GE(end, 3);
  EXPECT_LE(end, 4);
  for (const double t : {-1.0, 0.0, end, end + 1}) EXPECT_LT(farthest(bust->pointsAt(t), rest), 1e-15) << t;
  for (const double t : {1e-3, end - 1e-3}) EXPECT_LT(farthest(bust->pointsAt(t), rest), 1e-6) << t;
  // No point is faster than 1 m/s, or changes its speed by more than 1 g.
  const double h = 1e-3;
  double fastest = 0, hardest = 0;
  for (double t = 0; t < end; t += 0.01) {
    const auto before = bust->pointsAt(t - h), now = bust->pointsAt(t), after = bust->pointsAt(t + h);
    for (std::size_t i = 0; i < now.size(); ++i) {
      fastest = std::max(fastest, length(after[i] - before[i]) / (2 * h));
      hardest = std::max(hardest, length(after[i] + before[i] - now[i] * 2.0) / (h * h));
    }
  }
  std::printf("up to %.2f m/s and %.1f m/s^2\n", fastest, hardest);
  EXPECT_LT(fastest, 1);
  EXPECT_LT(hardest, 9.8);
}

TEST(BustMotion, NodsBy35DegreesAndShrugsBy4Centimetres) {
  const auto bust = generatedMotion("bust");
  const std::vector<Vec3d> rest = bust->pointsAt(0);
  const auto part = [&](const std::vector<Vec3d>& points, auto&& isOfIt) {
    std::vector<Vec3d> some;
    for (std::size_t i = 0; i < rest.size(); ++i)
      if (isOfIt(rest[i])) some.push_back(points[i]);
    return some;
  };
  const auto isSkull = [](Vec3d p) { return p.y > 0; };
  const auto isShoulder = [](Vec3d p) { return std::abs(p.x) > 0.17 && p.y > -0.23; };
  const auto isChest = [](Vec3d p) { return p.y < -0.355; };
  double mostNod = 0, mostShrug = 0;
  for (double t = 0; t < bust->lastSeconds(); t += kFrame / 4) {
    const std::vector<Vec3d> points = bust->pointsAt(t);
    // Positive about X: the face goes down.
    const Quatd turn = fitHeadRotation(part(rest, isSkull), part(points, isSkull));
    EXPECT_NEAR(turn.y, 0, 1e-9);
    EXPECT_NEAR(turn.z, 0, 1e-9);
    mostNod = std::max(mostNod, 2 * std::atan2(turn.x, turn.w));
    const auto still = part(rest, isShoulder), raised = part(points, isShoulder);
    ASSERT_GE(still.size(), 10u);
    double up = 0;
    for (std::size_t i = 0; i < still.size(); ++i)
      up += (raised[i].y - still[i].y) / static_cast<double>(still.size());
    mostShrug = std::max(mostShrug, up);
    EXPECT_LT(farthest(part(points, isChest), part(rest, isChest)), 1e-3) << "it stands";
  }
  EXPECT_NEAR(mostNod * 180 / std::numbers::pi, 35, 0.5);
  EXPECT_NEAR(mostShrug, 0.04, 0.004);
}

TEST(BustMotion, IsClosedAndNeverInsideOut) {
  const auto bust = generatedMotion("bust");
  const std::vector<Vec3d> rest = bust->pointsAt(0);
  EXPECT_TRUE(isWatertight({rest, bust->triangles()}));
  const double volume = volumeOf(rest, *bust);
  EXPECT_GT(volume, 0.01);
  const auto across = [&](const std::vector<Vec3d>& points, const MeshMotion::Triangle& t) {
    return cross(points[t[1]] - points[t[0]], points[t[2]] - points[t[0]]);
  };
  double least = 1, smallest = 1;
  for (double t = 0; t < bust->lastSeconds(); t += kFrame / 2) {
    const std::vector<Vec3d> points = bust->pointsAt(t);
    EXPECT_NEAR(volumeOf(points, *bust), volume, 0.1 * volume) << t;
    for (const auto& triangle : bust->triangles()) {
      const Vec3d before = across(rest, triangle), now = across(points, triangle);
      least = std::min(least, dot(normalizedOr(now, Vec3d{}), normalizedOr(before, Vec3d{})));
      smallest = std::min(smallest, length(now) / length(before));
    }
  }
  std::printf("triangles turn by up to %.0f degrees and keep %.2f of their area\n",
              std::acos(least) * 180 / std::numbers::pi, smallest);
  EXPECT_GT(least, 0.5) << "the nod is 35 degrees of 60";
  EXPECT_GT(smallest, 0.3);
}

// Outside of the bust at all times, from 4 mm at rest, and open in front; what is on the shoulders goes with
// them, and the wind lifts the hem alone.
TEST(BustMotion, TheCapeStaysOffTheBust) {
  const auto bust = generatedMotion("bust"), cape = generatedMotion("cape");
  const TriangleMesh rest{cape->pointsAt(0), cape->triangles()};
  EXPECT_TRUE(checkMesh(rest));
  EXPECT_EQ(cape->lastSeconds(), bust->lastSeconds());
  const Bounds bounds = boundsOf(rest);
  EXPECT_GT(bounds.high.y, -0.12) << "the collar stands up";
  EXPECT_LT(bounds.low.y, -0.42) << "the hem hangs below the bust";
  for (const Vec3d p : rest.points) EXPECT_FALSE(p.z > 0.02 && std::abs(p.x) < 0.02) << p.x << ", " << p.z;
  double nearest = 1, shoulder = 0, hem = 0;
  for (double t = 0; t < bust->lastSeconds() + kFrame; t += kFrame) {
    const TriangleTree tree({bust->pointsAt(t), bust->triangles()});
    const std::vector<Vec3d> points = cape->pointsAt(t);
    for (std::size_t i = 0; i < points.size(); ++i) {
      EXPECT_LT(tree.windingNumber(points[i]), 0.5) << t << " s, point " << i;
      nearest = std::min(nearest, tree.nearest(points[i]).distance);
      const double way = length(points[i] - rest.points[i]);
      (rest.points[i].y > bounds.low.y + 0.2 ? shoulder : hem) =
          std::max(rest.points[i].y > bounds.low.y + 0.2 ? shoulder : hem, way);
    }
  }
  std::printf("no nearer than %.2f mm, shoulders by %.1f mm, hem by %.1f mm\n", 1000 * nearest,
              1000 * shoulder, 1000 * hem);
  EXPECT_GT(nearest, 0.002);
  EXPECT_NEAR(shoulder, 0.041, 0.01);
  EXPECT_GT(hem, 0.05);
}

}  // namespace
}  // namespace ringlet::bust_motion_test
