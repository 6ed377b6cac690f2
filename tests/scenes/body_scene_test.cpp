// Hair among bodies, in wind and on heads that jump: what a user would see. Real motions and grooms where
// they are there.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ringlet/bodies/head_mesh.h"
#include "ringlet/bodies/mesh_file.h"
#include "ringlet/bodies/mesh_grid.h"
#include "ringlet/groom/generate.h"
#include "ringlet/groom/groom_file.h"
#include "ringlet/measure/body_watch.h"
#include "ringlet/motion/bvh_file.h"
#include "ringlet/rest/material_presets.h"
#include "ringlet/scenes/builtin_scene.h"
#include "ringlet/solver/simulation.h"
#include "tests/support/gpu_test.h"
#include "tests/support/test_support.h"

namespace ringlet::test::body_scene_test {
namespace {

constexpr double kDeepestAllowed = 0.0005;  // [m]

struct Seen {
  BodyNumbers bodies;
  SimulationReport report;
  double fastestTip = 0;  // [m/s]
  std::vector<Vec3f> last;
};

struct Cast {
  Groom groom;
  Material material = materialPreset("ringlet").value();
  Settings settings{};
  Motion motion{};
  std::vector<Body> bodies{};
};

class BodyScene : public GpuTest {
 protected:
  Seen run(const Cast& cast, int frames) {
    Seen run;
    const double T = cast.settings.stepSeconds();
    auto simulation = Simulation::create(
        device(), cast.groom, cast.material, cast.settings,
        {.head = cast.motion.poseAt(0), .oneStepEarlier = cast.motion.poseAt(-T), .bodies = cast.bodies});
    EXPECT_TRUE(simulation) << simulation.error().message;
    if (!simulation) return run;
    BodyWatch watch(cast.groom, cast.bodies, cast.settings.rootCount);
    for (int frame = 0; frame < frames; ++frame) {
      std::vector<HeadPose> poses;
      std::vector<double> times;
      for (int k = 1; k <= cast.settings.stepsPerFrame; ++k) {
        times.push_back((frame * cast.settings.stepsPerFrame + k) * T);
        poses.push_back(cast.motion.poseAt(times.back()));
      }
      const std::vector<BodyPose> bodyPoses = bodyPosesOf(cast.bodies, poses, times);
      EXPECT_TRUE(simulation->stepFrame(poses, bodyPoses));
      const auto state = simulation->state();
      watch.look(state->positions, poses.back(), std::span(bodyPoses).last(cast.bodies.size()));
      for (std::size_t s = 0; s < cast.groom.strandCount(); ++s) {
        const double speed = length(Vec3d(state->velocities[cast.groom.firstPoint[s + 1] - 1]));
        run.fastestTip = std::max(run.fastestTip, speed);
      }
      run.last = state->positions;
    }
    run.bodies = watch.numbers();
    run.report = *simulation->report();
    return run;
  }

  void expectOutside(const Seen& run, const Settings& settings, const char* what) {
    fmt::print("{}: deepest {:.4f} mm, longest edge {:.6f}\n", what, 1000 * run.bodies.deepest,
               run.report.maxEdgeStretch);
    EXPECT_LT(run.bodies.deepest, kDeepestAllowed) << what << ": strand " << run.bodies.strand << " particle "
                                                   << run.bodies.particle << " frame " << run.bodies.frame;
    EXPECT_LT(run.report.maxEdgeStretch, settings.maxStretch * (1 + 1e-3)) << what;
    EXPECT_EQ(run.report.nonfinite, 0u) << what;
  }
};

Body meshBody(const TriangleMesh& mesh, int cells = 64) {
  auto made = makeDistanceGrid(mesh, {.cells = cells});
  EXPECT_TRUE(made) << made.error().message;
  return {.name = "head",
          .shape = BodyShape::grid,
          .grid = std::make_shared<const DistanceGrid>(std::move(made->grid))};
}

Groom headOf(int strands) {
  HeadParameters head;
  head.strandCount = strands;
  auto made = makeHead(head);
  EXPECT_TRUE(made) << made.error().message;
  return std::move(*made);
}

TEST_F(BodyScene, AWalkingHeadKeepsItsHairOut) {
  SceneOptions options;
  options.strands = 60;
  options.contacts = false;
  const auto scene = makeScene("walk_head", options);
  ASSERT_TRUE(scene) << scene.error().message;
  ASSERT_EQ(scene->bodies.size(), 1u);
  const Cast cast{scene->groom, scene->material, scene->settings, scene->motion, scene->bodies};
  expectOutside(run(cast, 48), cast.settings, "walk_head");
}

TEST_F(BodyScene, MotionCapturesKeepHairOut) {
  RINGLET_NEEDS_DATA(walk, "bvh/cmu_12_01_walk.bvh");
  RINGLET_NEEDS_DATA(bank, "bvh/test_mocapbank.bvh");
  for (const auto& path : {walk, bank}) {
    const bool isWalk = path == walk;
    const auto file = readBvh(path);
    ASSERT_TRUE(file) << file.error().message;
    const auto joint = file->find("Head");
    ASSERT_TRUE(joint);
    // The walk's first frame is a T-pose; the bank's way down, of 80 cm, is in its first seconds.
    Keyframes keys = file->motionOf(*joint, isWalk ? 0.0703 : 0.01, isWalk ? 1 : 0);
    const int frames = std::min(192, static_cast<int>(keys.seconds() * 24));
    Cast cast{headOf(60), materialPreset("ringlet").value()};
    cast.motion = {.kind = MotionKind::keyframes,
                   .keyframes = std::make_shared<const Keyframes>(std::move(keys))};
    cast.bodies = {meshBody(makeHeadMesh())};
    expectOutside(run(cast, frames), cast.settings, path.filename().c_str());
  }
}

// Her guides, in centimetres, where her head is: by the least distance of roots and mesh.
TEST_F(BodyScene, SintelsHairStaysOutOfHerHead) {
  RINGLET_NEEDS_DATA(hair, "sintel/GEO-sintel_hair_emit.002-sintel_hair.tfx");
  RINGLET_NEEDS_DATA(head, "sintel/sintel-collider.obj");
  auto loaded = readGroom(hair);
  ASSERT_TRUE(loaded) << loaded.error().message;
  auto mesh = readObjMesh(head, 1);
  ASSERT_TRUE(mesh) << mesh.error().message;
  Cast cast{std::move(loaded->groom), Material{}};
  for (Vec3f& p : cast.groom.points)
    p = static_cast<Vec3f>(static_cast<Vec3d>(p) * 1.0206 + Vec3d{0.0009, 1.1903, 0.0045} * 100.0);
  cast.settings.stepsPerFrame = 10;
  cast.motion = {.kind = MotionKind::shake, .axis = {1, 0, 0}, .amplitude = 0.05, .frequency = 2};
  cast.bodies = {meshBody(*mesh)};
  expectOutside(run(cast, 48), cast.settings, "Sintel");
}

// A strand that begins half in a ball is out within a second, its tip never faster than 1 m/s.
TEST_F(BodyScene, HairThatBeginsInsideLeavesGently) {
  Cast cast{{}, Material{}};
  cast.groom.metresPerUnit = 1;
  std::vector<Vec3f> strand;
  for (int i = 0; i < 64; ++i) strand.push_back({0, static_cast<float>(-0.25 * i / 63), 0});
  cast.groom.addStrand(strand);
  Body ball{.name = "ball", .radius = 0.05};
  ball.place.position = {0.003, -0.16, 0.004};
  cast.bodies = {ball};
  const Seen seen = run(cast, 24);
  EXPECT_EQ(seen.bodies.inside, 0u);
  EXPECT_LT(seen.fastestTip, 1);
  EXPECT_LT(seen.bodies.deepest, kDeepestAllowed);
}

// 10 m away and a quarter round: seen from the head the hair is as it was, and goes on as it would have.
TEST_F(BodyScene, AJumpingHeadCarriesItsHair) {
  auto curl = makeCurl({});
  ASSERT_TRUE(curl);
  for (const double quarter : {0.0, 0.5 * std::numbers::pi}) {
    Settings settings;
    settings.gravity = {};  // which does not jump
    settings.gravityPreload = 0;
    const Quatd turn = fromRotationVector(Vec3d{0, quarter, 0});
    const auto pose = [&](double t) {
      return HeadPose{Vec3d{0.05 * std::sin(6 * t), 0, 0},
                      fromRotationVector(Vec3d{0, 0, 0.3 * std::sin(5 * t)})};
    };
    const auto away = [&](const HeadPose& p) {
      return HeadPose{Vec3d{10, 3, 0} + rotate(turn, p.position), turn * p.rotation};
    };
    const double T = settings.stepSeconds();
    auto jumping = Simulation::create(device(), *curl, Material{}, settings,
                                      {.head = pose(0), .oneStepEarlier = pose(-T)});
    auto staying = Simulation::create(device(), *curl, Material{}, settings,
                                      {.head = pose(0), .oneStepEarlier = pose(-T)});
    ASSERT_TRUE(jumping && staying);
    // In the frame of the jump the head goes on for no time at all.
    const auto frame = [&](Simulation& simulation, int index, bool isAway) {
      std::vector<HeadPose> poses;
      for (int k = 1; k <= settings.stepsPerFrame; ++k) {
        const HeadPose p = pose((index * settings.stepsPerFrame + k) * T);
        poses.push_back(isAway ? away(p) : p);
      }
      ASSERT_TRUE(simulation.stepFrame(poses));
    };
    const auto apart = [&] {
      const auto a = *jumping->positions(), b = *staying->positions();
      double farthest = 0;
      for (std::size_t i = 0; i < a.size(); ++i)
        farthest = std::max(farthest, length(Vec3d(a[i]) - rotate(turn, Vec3d(b[i]))));
      return farthest;
    };
    for (int index = 0; index < 12; ++index) {
      frame(*jumping, index, false);
      frame(*staying, index, false);
    }
    const HeadPose there = away(pose(12 * settings.stepsPerFrame * T));
    ASSERT_TRUE(jumping->stepFrame(std::vector<HeadPose>(settings.stepsPerFrame, there)));
    EXPECT_LT(apart(), 1e-6) << quarter;
    for (int index = 12; index < 24; ++index) {
      frame(*jumping, index, true);
      frame(*staying, index, false);
    }
    EXPECT_LT(apart(), 1e-4) << quarter;
  }
}

// A limp straight strand in an even wind W rests at the angle theta from the vertical where drag across
// balances weight, (W cos theta)^2 = U^2 sin theta, everywhere along it: it stays straight. Measured at its
// middle: a free end this limp flutters by some degrees in the strongest wind, at any number of steps.
TEST_F(BodyScene, AStrandHangsInTheWindAtItsAngle) {
  for (const double share : {0.5, 1.0, 2.0}) {
    Cast cast{{}, Material{}};
    cast.groom.metresPerUnit = 1;
    std::vector<Vec3f> strand;
    for (int i = 0; i < 32; ++i) strand.push_back({0, static_cast<float>(-0.25 * i / 31), 0});
    cast.groom.addStrand(strand);
    cast.material.bendStiffness = 0.002;
    cast.material.coreStiffness = 0;
    cast.settings.gravityPreload = 0;
    cast.settings.air = {.on = true, .fallSpeed = 3, .wind = {3 * share, 0, 0}};
    const Seen seen = run(cast, 24 * 8);
    const Vec3f middle = seen.last[16];
    const double angle = std::atan2(middle.x, -middle.y), c = 1 / (share * share);
    const double expected = std::asin((std::sqrt(c * c + 4) - c) / 2);
    fmt::print("wind {} x the fall speed: {:.2f} degrees, expected {:.2f}\n", share,
               angle * 180 / std::numbers::pi, expected * 180 / std::numbers::pi);
    EXPECT_NEAR(angle, expected, 0.01) << share;  // what is left of bending at the root
    EXPECT_NEAR(middle.z, 0, 1e-5);
  }
}

}  // namespace
}  // namespace ringlet::test::body_scene_test
