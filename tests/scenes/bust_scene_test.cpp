// The built-in scene `bust`: roots go with the mesh that hair collides with, and hair lies on its shoulders
// and stays out of it while it nods and shrugs.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "ringlet/bodies/triangle_tree.h"
#include "ringlet/measure/body_watch.h"
#include "ringlet/run/device_hair.h"
#include "ringlet/scenes/builtin_scene.h"
#include "ringlet/scenes/frames/scene_frames.h"
#include "tests/support/gpu_test.h"

namespace ringlet::test::bust_scene_test {
namespace {

constexpr double kDeepestAllowed = 0.001;  // [m]

Result<BuiltinScene> bust() { return makeScene("bust", {.strands = 40, .contacts = false}); }

// The body's triangles as a frame ends.
TriangleTree treeOf(const BuiltinScene& scene, const SceneFrame& frame) {
  return TriangleTree({frame.pointsAtEnd()[0], scene.moving[0].mesh->triangles()});
}

TEST(BustMeshScene, RootsStayOnTheBody) {
  const auto scene = bust();
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->warnings, std::vector<std::string>());
  ASSERT_EQ(scene->bodies.size(), 1u);
  ASSERT_TRUE(scene->bodies[0].bends());
  ASSERT_EQ(scene->moving.size(), 1u);
  ASSERT_TRUE(scene->scalp);
  const Groom& groom = scene->groom;
  const SceneFrames frames(*scene);
  double farthest = 0, way = 0;
  for (int number = 0; number < scene->frameCount; ++number) {
    const auto frame = frames.at(number);
    ASSERT_TRUE(frame);
    const TriangleTree tree = treeOf(*scene, *frame);
    const auto roots = frame->rootsAtEnd();
    ASSERT_EQ(roots.size(), groom.strandCount());
    for (std::size_t s = 0; s < groom.strandCount(); ++s) {
      const Vec3d first = Vec3d(groom.strand(s).front()) * groom.metresPerUnit;
      const Vec3d root =
          roots[s].position + rotate(roots[s].rotation, first);  // the head stands at the origin
      farthest = std::max(farthest, tree.nearest(root).distance);
      way = std::max(way, length(root - first));
    }
  }
  fmt::print("roots up to {:.4f} mm from the body, moved by up to {:.0f} mm\n", farthest * 1000, way * 1000);
  EXPECT_LT(farthest, 1e-4);
  EXPECT_GT(way, 0.1) << "it nods";
}

class BustScene : public GpuTest {};

TEST_F(BustScene, HairStaysOutAndLiesOnItsShoulders) {
  const auto scene = bust();
  ASSERT_TRUE(scene) << scene.error().message;
  const SceneFrames frames(*scene);
  auto simulation = makeSimulation({*scene, frames}, {device()});
  ASSERT_TRUE(simulation) << simulation.error().message;
  BodyWatch watch(scene->groom, scene->bodies, scene->settings.rootCount);
  std::size_t leastOnShoulders = scene->groom.points.size();
  std::vector<Vec3f> positions;
  for (int number = 0; number < scene->frameCount; ++number) {
    const auto frame = frames.at(number);
    ASSERT_TRUE(frame);
    ASSERT_TRUE(simulation->stepFrame(frame->heads, frame->bodies, frame->roots, frame->bodyPoints()));
    positions = *simulation->positions();
    const auto ends = frame->pointsAtEnd();
    const std::vector<std::span<const Vec3d>> points(ends.begin(), ends.end());
    watch.look(positions, frame->heads.back(), frame->bodiesAtEnd(), points);
    if (number < 48) continue;  // it falls, and the head nods
    const TriangleTree tree = treeOf(*scene, *frame);
    leastOnShoulders =
        std::min(leastOnShoulders, static_cast<std::size_t>(std::ranges::count_if(positions, [&](Vec3f p) {
                   return std::abs(p.x) > 0.06f && p.y < -0.1f && tree.nearest(Vec3d(p)).distance < 0.005;
                 })));
  }
  const BodyNumbers numbers = watch.numbers();
  fmt::print("deepest {:.4f} mm, {} begin inside, at least {} particles on the shoulders\n",
             1000 * numbers.deepest, numbers.inside, leastOnShoulders);
  EXPECT_LT(numbers.deepest, kDeepestAllowed)
      << "strand " << numbers.strand << " particle " << numbers.particle << " frame " << numbers.frame;
  EXPECT_EQ(numbers.inside, 0u);
  EXPECT_GT(leastOnShoulders, 50u);
  EXPECT_EQ(simulation->report()->nonfinite, 0u);
}

}  // namespace
}  // namespace ringlet::test::bust_scene_test
