// scenes/load/world_bind.h: what is bound to the world stands where it was modelled at its frame, whatever
// axes the joint has, and goes along from there.
#include "ringlet/scenes/load/world_bind.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "ringlet/scenes/load/load_scene.h"
#include "tests/scenes/joint_samples.h"
#include "tests/support/test_support.h"

namespace ringlet::world_bind_test {
namespace {

using test::kJointAxes;
using test::kJointHeight;

LoadedScene loaded(const std::string& text, const std::filesystem::path& folder) {
  const auto scene = parseScene(text, "the scene", folder);
  EXPECT_TRUE(scene) << scene.error().message;
  auto made = loadScene(*scene);
  EXPECT_TRUE(made) << made.error().message;
  return std::move(*made);
}

// Modelled in the world, about the joint at the bind frame: curls of a head, 1.5 m up.
std::string groomText(const std::string& bind) {
  return "[groom]\ngenerate = \"swatch\"\ncolumns = 3\nrows = 2\nparticles = 12\noffset = [0.1, 1.6, "
         "0.05]\n" +
         bind;
}

std::vector<Vec3d> inWorld(const LoadedScene& scene, double t) {
  const HeadPose head = scene.motion.poseAt(t);
  std::vector<Vec3d> points;
  for (Vec3f p : scene.groom.points)
    points.push_back(head.position + rotate(head.rotation, Vec3d(p) * scene.groom.metresPerUnit));
  return points;
}

double farthest(const std::vector<Vec3d>& a, const std::vector<Vec3d>& b) {
  EXPECT_EQ(a.size(), b.size());
  double off = 0;
  for (std::size_t i = 0; i < a.size(); ++i) off = std::max(off, length(a[i] - b[i]));
  return off;
}

// How the world goes along with the head from frame `from` on to frame `to`, from 0.
Vec3d carried(Vec3d p, int from, int to) {
  const double angle = (test::jointTurn(to) - test::jointTurn(from)) * std::numbers::pi / 180;
  const Vec3d before{test::jointWay(from), kJointHeight, 0}, after{test::jointWay(to), kJointHeight, 0};
  return after + rotate(fromRotationVector(Vec3d{0, 0, angle}), p - before);
}

TEST(WorldBind, AGroomStandsWhereItWasModelledWhateverAxesTheJointHas) {
  const auto folder = test::scratchFolder("world_bind");
  const std::vector<Vec3d> modelled = inWorld(loaded(groomText(""), folder), 0);
  for (const auto& axis : kJointAxes) {
    for (const char* kind : {"bvh", "gltf"}) {
      const std::string file = std::string("joint.") + kind;
      (kind == std::string("bvh") ? test::writeBvhOf : test::writeGltfOf)(axis, folder / file);
      for (const int frame : {1, 5}) {
        SCOPED_TRACE(fmt::format("{} {} up, frame {}", kind, axis.name, frame));
        const std::string bind = fmt::format("bind = \"world\"\n{}[motion]\nfile = \"{}\"\n{}",
                                             frame > 1 ? fmt::format("bind_frame = {}\n", frame) : "", file,
                                             kind == std::string("bvh") ? "unit = 0.01\n" : "");
        const LoadedScene scene = loaded(groomText(bind), folder);
        const double bound = (frame - 1) / 24.0;
        EXPECT_LT(farthest(inWorld(scene, bound), modelled), 1e-6);
        const HeadPose head = scene.motion.poseAt(bound);
        EXPECT_LT(std::abs(std::abs(head.rotation.w) - 1), 1e-9) << "the groom's own axes are the world's";
        for (const int to : {0, 3, 12}) {
          std::vector<Vec3d> expected;
          for (Vec3d p : modelled) expected.push_back(carried(p, frame - 1, to));
          EXPECT_LT(farthest(inWorld(scene, to / 24.0), expected), 1e-6) << to;
        }
        for (Vec3f p : scene.groom.points)
          EXPECT_LT(length(Vec3d(p)) * scene.groom.metresPerUnit, 0.7) << "the joint is the origin";
      }
    }
  }
}

TEST(WorldBind, WhatIsBoundToTheHeadKeepsItsBits) {
  const auto folder = test::scratchFolder("world_bind_head");
  test::writeBvhOf(kJointAxes[0], folder / "joint.bvh");
  const std::string motion = "[motion]\nfile = \"joint.bvh\"\nunit = 0.01\n";
  const LoadedScene plain = loaded(groomText(motion), folder),
                    stated = loaded(groomText("bind = \"head\"\nbind_frame = 7\n" + motion), folder);
  EXPECT_EQ(plain.groom.points, stated.groom.points);
  EXPECT_EQ(plain.motion.axes, Quatd{});
  EXPECT_EQ(stated.motion.axes, Quatd{});
}

// Bodies of every carrier: the head, with its own axes or the world's, a joint, their own motion.
TEST(WorldBind, BodiesStandWhereTheyArePlaced) {
  const auto folder = test::scratchFolder("world_bind_bodies");
  test::writeBvhOf(kJointAxes[4], folder / "joint.bvh");
  const std::string ball =
      "[[body]]\nshape = \"sphere\"\nposition = [0.3, 1.2, 0.1]\nrotate_degrees = [20, 0, 0]\n"
      "bind = \"world\"\n";
  const std::string keys =
      "moves = { key = [{ time = 0, rotate_degrees = [0, 0, 0] }, { time = 1, rotate_degrees = [0, 90, 0] }] "
      "}\n";
  for (const char* groom : {"", "bind = \"world\"\nbind_frame = 3\n"}) {
    for (const std::string& carrier : {std::string(), std::string("joint = \"Hips\"\n"), keys}) {
      for (const int frame : {1, 3, 9}) {
        SCOPED_TRACE(fmt::format("groom {} body {} frame {}", groom, carrier, frame));
        // The groom's frame holds where the body says none.
        const bool isGrooms = frame == (*groom ? 3 : 1);
        const LoadedScene scene =
            loaded(groomText(groom) + "[motion]\nfile = \"joint.bvh\"\nunit = 0.01\n" + ball +
                       (isGrooms ? "" : fmt::format("bind_frame = {}\n", frame)) + carrier,
                   folder);
        const double t = (frame - 1) / 24.0;
        const BodyPose pose = scene.bodies.front().poseAt(t, scene.motion.poseAt(t));
        EXPECT_LT(length(pose.position - Vec3d{0.3, 1.2, 0.1}), 1e-9);
        const Vec3d up = rotate(pose.rotation, Vec3d{0, 1, 0});
        const double tilt = 20 * std::numbers::pi / 180;
        EXPECT_LT(length(up - Vec3d{0, std::cos(tilt), std::sin(tilt)}), 1e-9);
        if (carrier == keys) continue;
        const BodyPose later = scene.bodies.front().poseAt(0.5, scene.motion.poseAt(0.5));
        EXPECT_LT(length(later.position - carried({0.3, 1.2, 0.1}, frame - 1, 12)), 1e-6);
      }
    }
  }
}

}  // namespace
}  // namespace ringlet::world_bind_test
