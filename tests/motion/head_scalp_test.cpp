// motion/head_scalp.h: what composes to the scalp's own motion, and where roots are when there is none.
#include "ringlet/motion/head_scalp.h"
#include "ringlet/motion/skinned_mesh.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/motion/gltf_samples.h"

namespace ringlet::test::head_scalp_test {
namespace {

Vec3d carried(const HeadPose& pose, Vec3d x) { return pose.position + rotate(pose.rotation, x); }
Vec3d carried(const BodyPose& pose, Vec3d x) { return pose.position + rotate(pose.rotation, x); }
HeadPose poseOf(Vec3d position, Vec3d turn) { return {position, fromRotationVector(turn)}; }

std::shared_ptr<const GltfFile> fileOf(const GltfBuilder& builder) {
  auto file = parseGltf(bytesOf(builder.glb()), "");
  EXPECT_TRUE(file) << file.error().message;
  return std::make_shared<const GltfFile>(std::move(*file));
}
std::shared_ptr<const SkinnedMesh> meshOf(std::shared_ptr<const GltfFile> file) {
  auto mesh = SkinnedMesh::of(std::move(file));
  EXPECT_TRUE(mesh) << mesh.error().message;
  return std::make_shared<const SkinnedMesh>(std::move(*mesh));
}
Motion keyed(Keyframes keys) {
  return {.kind = MotionKind::keyframes, .keyframes = std::make_shared<const Keyframes>(std::move(keys))};
}

// A glTF triangle on a node that travels and turns, from 0.5 s to 1.5 s.
GltfBuilder travelling() {
  GltfBuilder builder;
  builder.root["meshes"] = {
      {{"primitives",
        {{{"attributes", {{"POSITION", builder.floats({0, 0, 0, 0.2, 0, 0, 0, 0, 0.2}, "VEC3")}}}}}}}};
  builder.node({{"name", "Head"}, {"mesh", 0}});
  const double half = std::sqrt(0.5);
  builder.channel(0, 0, "translation", "LINEAR", {0.5, 1.5}, {0, 1.5, 0, 0.4, 1.6, -0.2});
  builder.channel(0, 0, "rotation", "LINEAR", {0.5, 1.5}, {0, 0, 0, 1, 0, half, 0, half});
  return builder;
}

const std::vector<Vec3d> kRoots{{0.05, 0, 0.05}, {0.1, 0, 0.02}, {0.01, 0.004, 0.1}};

TEST(HeadScalp, ComposesToTheScalpsMotion) {
  const HeadPose bound = poseOf({0.3, 1.4, -0.1}, {0.2, 1, 0}), head = poseOf({-2, 1, 4}, {0, -2, 0.7}),
                 scalp = poseOf({1, 0.1, 3}, {1, 0.5, -0.4});
  const BodyPose root = rootPoseOn(head, scalp, bound);
  for (Vec3d x : {Vec3d{}, Vec3d{0.1, -0.2, 0.05}, Vec3d{1, 2, 3}})
    EXPECT_LT(length(carried(head, carried(root, x)) - carried(scalp, carried(bound, x))), 1e-14);
  const BodyPose none = rootPoseOn(bound, {}, bound);
  EXPECT_LT(length(none.position), 1e-15);
  EXPECT_LT(length(Vec3d{none.rotation.x, none.rotation.y, none.rotation.z}), 1e-15);
}

// A head that follows the node has the mesh with it, wherever the scene has put it: roots stay where they
// are.
TEST(HeadScalp, OfARigidMeshComesWithItsHead) {
  const auto file = fileOf(travelling());
  auto keys = file->motionOf(0, &file->animations[0], {}, {});
  ASSERT_TRUE(keys) << keys.error().message;
  Motion head = keyed(std::move(*keys));
  head.start = {10, 20, 30};
  const auto scalp = HeadScalp::bind(meshOf(file), kRoots, head, {.offset = head.start});
  ASSERT_TRUE(scalp) << scalp.error().message;
  EXPECT_NEAR(scalp->scalp().farthestRoot(), 0.004, 1e-7);
  for (double t : {-0.5, 0.0, 0.31, 0.9, 1.0}) {
    for (const BodyPose& pose : scalp->rootPosesAt(t)) {
      EXPECT_LT(length(pose.position), 1e-6) << t;  // the head goes on cubics between sampled keys
      EXPECT_LT(length(Vec3d{pose.rotation.x, pose.rotation.y, pose.rotation.z}), 1e-6) << t;
    }
  }
  EXPECT_FALSE(HeadScalp::bind(meshOf(file), kRoots, head)) << "20 m above";
}

// Where the head goes its own way roots are on the mesh all the same, from `start` on.
TEST(HeadScalp, IsOnTheMeshWhereverTheHeadIs) {
  const auto file = fileOf(travelling());
  Motion head{.kind = MotionKind::spin, .axis = {0, 1, 0}, .amplitude = 2, .easeSeconds = 0.5};
  head.start = {0, 1.5, 0};
  const HeadPose bound = head.poseAt(0.25);
  std::vector<Vec3d> roots;
  for (Vec3d root : kRoots) roots.push_back(rotate(bound.rotation.conjugate(), root));  // on the mesh then
  const auto scalp = HeadScalp::bind(meshOf(file), roots, head, {.start = 0.25});
  ASSERT_TRUE(scalp) << scalp.error().message;
  for (double t : {0.25, 0.5, 1.0, 1.25, 3.0}) {
    const Affine node = file->worldAt(0, &file->animations[0], 0.5 + t - 0.25);
    const std::vector<BodyPose> poses = scalp->rootPosesAt(t);
    for (std::size_t r = 0; r < roots.size(); ++r)
      EXPECT_LT(length(carried(head.poseAt(t), carried(poses[r], roots[r])) - node(kRoots[r])), 1e-7) << t;
  }
  for (const BodyPose& pose : scalp->rootPosesAt(0.2)) EXPECT_TRUE(pose.position == Vec3d{});
}

// From key to key of a jump a head is not seen to move; nor are roots, as seen from it.
TEST(HeadScalp, StaysAsItWasWhileTheHeadIsCut) {
  const auto file = fileOf(travelling());
  for (const bool hasTimes : {false, true}) {
    Keyframes keys;
    keys.secondsPerKey = 0.25;
    keys.cutSpeed = 24;
    for (double x : {0.0, 0.01, 20.01, 20.02}) keys.poses.push_back({{x, 1.5, 0}, {}});
    if (hasTimes) keys.times = {0, 0.25, 0.5, 0.75};
    const auto scalp = HeadScalp::bind(meshOf(file), kRoots, keyed(keys));
    ASSERT_TRUE(scalp) << scalp.error().message;
    const auto before = scalp->rootPosesAt(0.25), during = scalp->rootPosesAt(0.4);
    for (std::size_t r = 0; r < kRoots.size(); ++r) {
      EXPECT_LT(length(before[r].position), 1);
      EXPECT_TRUE(during[r].position == before[r].position);
      EXPECT_GT(length(scalp->rootPosesAt(0.5)[r].position), 19) << "this mesh does not jump with it";
      EXPECT_LT(length(scalp->rootPosesAt(0.2)[r].position - before[r].position), 0.1);
    }
  }
}

// Of weights only their ratios count: exporters write sums that are not 1.
TEST(SkinnedMesh, WeightsAreShares) {
  for (const double sum : {1.0, 0.5, 0.997, 3.0}) {
    for (const int type : {5126, 5123, 5121}) {
      if (type != 5126 && sum > 1) continue;  // which these cannot hold
      const auto mesh = meshOf(fileOf(bendingStrip(8, 5121, type, sum)));
      const double rounding = type == 5126 ? 1e-6 : type == 5123 ? 2e-4 : 0.02;
      for (const double t : {0.0, 0.4, 1.0}) {
        const std::vector<Vec3d> rest = mesh->pointsAt(0), now = mesh->pointsAt(t);
        for (std::size_t p = 0; p < rest.size(); ++p) {
          const Vec3d made{static_cast<double>(p / 2) / 4, 0, p % 2 == 0 ? -0.1 : 0.1};
          EXPECT_LT(length(rest[p] - made), rounding) << sum << " " << type;
          EXPECT_LT(length(now[p] - bentPoint(made, t)), rounding) << sum << " " << type << " at " << t;
        }
      }
    }
  }
}

}  // namespace
}  // namespace ringlet::test::head_scalp_test
