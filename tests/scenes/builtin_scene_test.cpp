// Built-in scenes as such: what may be asked of them, and heads that rest at the start.
#include "ringlet/scenes/builtin_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "ringlet/rest/rest_state.h"

namespace ringlet::test::builtin_scene_test {
namespace {

// How far a pose is from another: metres and radians, added.
double distance(const HeadPose& a, const HeadPose& b) {
  const Quatd turn = a.rotation * b.rotation.conjugate();
  return length(a.position - b.position) + 2 * length(Vec3d{turn.x, turn.y, turn.z});
}

void expectError(std::string_view name, const SceneOptions& options, const std::string& part) {
  const auto scene = makeScene(name, options);
  ASSERT_FALSE(scene) << part;
  EXPECT_NE(scene.error().message.find(part), std::string::npos) << scene.error().message;
}

// 8 columns of 4 rows: how far apart roots are along one axis, over the other.
TEST(BuiltinScene, AReleasedSwatchIsWiderThanItIsHigh) {
  const auto scene = makeScene("release");
  ASSERT_TRUE(scene) << scene.error().message;
  const Groom& groom = scene->groom;
  const auto extent = [&](float Vec3f::*axis) {
    std::vector<float> places;
    for (std::size_t s = 0; s < groom.strandCount(); ++s) places.push_back(groom.strand(s).front().*axis);
    const auto [least, most] = std::ranges::minmax(places);
    return most - least;
  };
  EXPECT_NEAR(extent(&Vec3f::y) / extent(&Vec3f::x), 3.0 / 7, 0.13);
}

TEST(BuiltinScene, EveryOneStartsAtRest) {
  for (const std::string& name : sceneNames()) {
    const auto scene = makeScene(name);
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_EQ(scene->name, name);
    EXPECT_FALSE(sceneSummary(name).empty());
    const Motion& motion = scene->motion;
    EXPECT_EQ(distance(motion.poseAt(0), HeadPose{}), 0) << name;
    EXPECT_EQ(distance(motion.poseAt(-1), HeadPose{}), 0) << name;
    // The swing begins with s^3 of the ease times its own first power: below 1 um in the first millisecond.
    EXPECT_LT(distance(motion.poseAt(1e-3), HeadPose{}), 1e-6) << name;
    EXPECT_EQ(motion.poseAt(0).shift, 0) << name;
    EXPECT_EQ(motion.poseAt(-1).shift, 0) << name;
    EXPECT_LT(std::abs(motion.poseAt(1e-3).shift), 1e-6) << name;
    const auto rest = buildRestState(scene->groom, scene->material, scene->settings);
    ASSERT_TRUE(rest) << rest.error().message;
    EXPECT_EQ(rest->warnings.size(), 0u) << name << ": " << rest->warnings.at(0);
  }
}

TEST(BuiltinScene, AWalkIsPeriodicAndStaysOnTheSpot) {
  const Motion walk = *motionByName("walk", {0, 1, 0});
  double farthest = 0, lowest = 0, highest = 0;
  for (double t = 1; t < 2; t += 0.01) {
    EXPECT_LT(distance(walk.poseAt(t), walk.poseAt(t + 5 / walk.frequency)), 1e-12);
    farthest = std::max(farthest, distance(walk.poseAt(t), HeadPose{}));
    lowest = std::min(lowest, walk.poseAt(t).position.y);
    highest = std::max(highest, walk.poseAt(t).position.y);
  }
  EXPECT_NEAR(highest, walk.amplitude, 1e-4);
  EXPECT_NEAR(lowest, -walk.amplitude, 1e-4);
  EXPECT_LT(farthest, 0.2);  // 2.5 cm, 2 cm, and some 6 degrees
}

TEST(BuiltinScene, AMotionWithAnEndIsOverByThen) {
  for (const char* name : {"shake", "nod", "walk", "jump"}) {
    Motion motion = *motionByName(name, {0, 1, 0});
    motion.untilSeconds = 2.1;
    EXPECT_GT(distance(motion.poseAt(1.1), HeadPose{}), 1e-3) << name;
    EXPECT_LT(distance(motion.poseAt(2.1 - 1e-3), HeadPose{}), 1e-6) << name;
    EXPECT_EQ(distance(motion.poseAt(2.2), HeadPose{}), 0) << name;
  }
}

TEST(BuiltinScene, ATurnGoesRoundOnceAndStays) {
  const Motion turn = *motionByName("turn", {0, 1, 0});
  EXPECT_GT(distance(turn.poseAt(0.8), turn.poseAt(1)), 1e-3);
  EXPECT_EQ(distance(turn.poseAt(1), turn.poseAt(5)), 0);
  const Vec3d crown = rotate(turn.poseAt(1).rotation, Vec3d{0, 1, 0});
  EXPECT_LT(length(crown - Vec3d{0, -1, 0}), 1e-12) << "upside down";
}

TEST(BuiltinScene, AJumpCrouchesLeapsAndLands) {
  const Vec3d up{0, 0, 1};
  const Motion jump = *motionByName("jump", up);
  EXPECT_EQ(distance(jump.poseAt(-1), HeadPose{}), 0);
  const double start = 3, period = 1 / jump.frequency;
  EXPECT_LT(length(jump.poseAt(start).position), 1e-12) << "stands";
  EXPECT_LT(length(jump.poseAt(start + period / 2).position - up * jump.amplitude), 1e-12)
      << "at its highest";
  double lowest = 0;
  const double h = 1e-4;
  for (double t = 0; t < 4; t += h) {
    const Vec3d p = jump.poseAt(t).position;
    lowest = std::min(lowest, p.z);
    EXPECT_LT(length(jump.poseAt(t + h).position + jump.poseAt(t - h).position - p * 2.0) / (h * h), 20.0)
        << "no jolt beyond 2 g: " << t;
  }
  EXPECT_NEAR(lowest, -0.2 * jump.amplitude, 0.01 * jump.amplitude) << "crouches";
}

TEST(BuiltinScene, AWhipGoesToTheSideAndBack) {
  const Motion whip = *motionByName("whip", {0, 1, 0});
  EXPECT_EQ(distance(whip.poseAt(-1), HeadPose{}), 0);
  EXPECT_LT(distance(whip.poseAt(1e-3), HeadPose{}), 1e-6);
  const Vec3d face = rotate(whip.poseAt(whip.easeSeconds).rotation, Vec3d{0, 0, 1});
  EXPECT_NEAR(std::atan2(face.x, face.z), whip.amplitude, 1e-12);
  EXPECT_LT(distance(whip.poseAt(2 * whip.easeSeconds), HeadPose{}), 1e-12);
  EXPECT_LT(distance(whip.poseAt(9), HeadPose{}), 1e-12);
}

TEST(RootMotion, GoesOutAndBackSmoothly) {
  const RootMotion never, press{.easeSeconds = 1, .untilSeconds = 4},
      hold{.easeSeconds = 1, .untilSeconds = std::numeric_limits<double>::infinity()},
      sway{.frequency = 2, .easeSeconds = 0.5, .untilSeconds = 3};
  double before = 0;
  for (double t = -1; t < 6; t += 1e-3) {
    EXPECT_EQ(never.shareAt(t), 0);
    EXPECT_GE(press.shareAt(t), 0);
    EXPECT_LE(std::abs(press.shareAt(t) - before), 1.9e-3) << "15 / 8 of the mean speed at the most: " << t;
    before = press.shareAt(t);
    if (t < 0 || t > 4) {
      EXPECT_EQ(press.shareAt(t), 0) << t;
    }
    if (t < 0 || t > 3) {
      EXPECT_EQ(sway.shareAt(t), 0) << t;
    }
    if (t > 1) {
      EXPECT_EQ(hold.shareAt(t), 1) << t;
    }
    if (t > 0.5 && t < 2.5) {
      EXPECT_NEAR(sway.shareAt(t), std::sin(4 * std::numbers::pi * t), 1e-12) << t;
    }
  }
  EXPECT_EQ(press.shareAt(2), 1);
}

// Two halves of as many strands each, which go opposite ways; and no scene prunes pairs.
TEST(BuiltinScene, HairThatComesTogetherDoesSoUnpruned) {
  for (const char* name : {"two_curls", "curtain", "pile"}) {
    const auto scene = makeScene(name);
    ASSERT_TRUE(scene) << scene.error().message;
    const std::size_t half = scene->groom.strandCount() / 2;
    ASSERT_EQ(scene->rootShifts.size(), 2 * half) << name;
    for (std::size_t s = 0; s < half; ++s) {
      EXPECT_EQ(scene->rootShifts[s], scene->rootShifts[0]);
      EXPECT_EQ(scene->rootShifts[half + s], scene->rootShifts[0] * -1.0);
    }
  }
  for (const std::string& name : sceneNames()) {
    const auto scene = makeScene(name), off = makeScene(name, {.contacts = false});
    ASSERT_TRUE(scene && off) << name;
    EXPECT_EQ(scene->showsContacts, sceneShowsContacts(name));
    EXPECT_FALSE(scene->settings.contacts.prunePairs) << name;
    EXPECT_EQ(scene->settings.contacts.on, sceneShowsContacts(name));
    EXPECT_FALSE(off->settings.contacts.on);
    if (sceneShowsContacts(name) && name != "head" && name != "walk_head") {  // which are dense
      EXPECT_TRUE(scene->settings.contacts.fillGaps) << name;
    }
  }
}

TEST(BuiltinScene, TakesItsOptions) {
  const auto scene = makeScene("hanging_curl", {.particles = 128,
                                                .strands = 5,
                                                .preload = 0.25,
                                                .bendStiffness = 7,
                                                .contacts = true,
                                                .core = false,
                                                .smoothedFrames = false,
                                                .stepsPerFrame = 16,
                                                .seconds = 2});
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->groom.strandCount(), 5u);
  EXPECT_EQ(scene->groom.strand(4).size(), 128u);
  EXPECT_EQ(scene->settings.gravityPreload, 0.25);
  EXPECT_EQ(scene->material.bendStiffness, 7);
  EXPECT_TRUE(scene->settings.contacts.on);
  EXPECT_EQ(scene->settings.stepsPerFrame, 16);
  EXPECT_EQ(scene->material.coreStiffness, 0);
  EXPECT_EQ(scene->material.bendSmoothingLength, 0);
  EXPECT_EQ(scene->frameCount, 48);

  const auto swatches = makeScene("pile", {.particles = 32, .strands = 13});
  ASSERT_TRUE(swatches) << swatches.error().message;
  EXPECT_EQ(swatches->groom.strandCount(), 36u) << "three rows of six each";
  EXPECT_EQ(swatches->rootShifts.size(), 36u);

  const auto paper = makeScene("release", {.integrator = Integrator::paper});
  ASSERT_TRUE(paper) << paper.error().message;
  EXPECT_EQ(paper->settings.stepsPerFrame, 30);
  EXPECT_EQ(paper->settings.gravityPreload, 0);
}

TEST(BuiltinScene, WarnsOfCurlsCutTooCoarsely) {
  for (const std::string& name : sceneNames()) {
    const auto enough = makeScene(name, {.particles = 32}), few = makeScene(name, {.particles = 31});
    ASSERT_TRUE(enough && few) << name;
    EXPECT_EQ(enough->warnings.size(), 0u) << name;
    EXPECT_EQ(few->warnings.size(), name == "twist_jump" ? 0u : 1u) << "only this one has no curl: " << name;
  }
  EXPECT_EQ(makeScene("release", {.particles = 16})->warnings.at(0),
            "16 particles are 2 for each of the 8 turns; a curl holds its shape from 4, 32 in all");
}

TEST(BuiltinScene, SaysWhatIsWrong) {
  expectError("walk", {}, "there are hanging_curl, walk_cycle, head_shake, bounce, twist_jump, release");
  expectError("hanging_curl", {.particles = 1}, "particle");
  expectError("hanging_curl", {.strands = 0}, "0 strands");
  expectError("hanging_curl", {.preload = 2}, "2");
  expectError("hanging_curl", {.stepsPerFrame = 0}, "0");
  expectError("hanging_curl", {.seconds = -1}, "-1 seconds");
  expectError("twist_jump", {.particles = 15}, "16 to 65536");
  expectError("head_shake", {.core = false, .integrator = Integrator::paper}, "leave the switch out");
  expectError("two_curls", {.strands = 3}, "has its two strands");
  expectError("two_curls", {.integrator = Integrator::paper}, "contacts need jacobi");
  expectError("bust", {.contacts = false, .integrator = Integrator::paper}, "jacobi");
  expectError("bounce", {.bendStiffness = 1, .integrator = Integrator::paper}, "leave the stiffness out");
  expectError("bounce", {.bendStiffness = -1}, "-1");
  expectError("head_shake", {.preload = 1, .integrator = Integrator::paper}, "no preload");
}

}  // namespace
}  // namespace ringlet::test::builtin_scene_test
