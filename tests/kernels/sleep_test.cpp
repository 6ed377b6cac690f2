// Hair that rests sleeps (Settings::sleepSpeed): its frames have no steps, and whatever acts on it wakes it.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include "ringlet/solver/diagnostics.h"
#include "tests/kernels/sample_hairs.h"
#include "tests/support/gpu_test.h"

namespace ringlet::test::sleep_test {
namespace {

using Sleep = GpuTest;

constexpr double kSpeed = 0.01;  // [m/s]: hair here is at rest within a few frames

std::vector<Hair> sleepyHairs() {
  std::vector<Hair> sleepy = hairs();
  // Strands that begin inside of bodies tremble.
  for (Hair& hair : sleepy) hair.settings.sleepSpeed = hair.bodies.empty() ? kSpeed : 1;
  return sleepy;
}

Simulation simulationOf(const ComputeDevice& device, const Hair& hair) {
  return *Simulation::create(*build(device, hair), {.bodies = hair.bodies});
}

bool sleeps(const Simulation& simulation) {
  const std::vector<std::string> frame = Diagnostics(simulation).recordedFrame();
  return std::ranges::none_of(frame, [](const auto& command) { return command.starts_with("strand_step"); });
}

// Of a head that stands still.
std::vector<HeadPose> stillPoses(const Settings& settings) {
  return std::vector<HeadPose>(static_cast<std::size_t>(settings.stepsPerFrame));
}

// Steps until it sleeps; false: it does not within so many frames.
bool fallsAsleep(Simulation& simulation, int frames = 200) {
  const std::vector<HeadPose> poses = stillPoses(simulation.settings());
  for (int frame = 0; frame < frames; ++frame) {
    if (!simulation.stepFrame(poses)) return false;
    if (sleeps(simulation)) return true;
  }
  return false;
}

TEST_F(Sleep, HairAtRestHasNoSteps) {
  for (const Hair& hair : sleepyHairs()) {
    SCOPED_TRACE(hair.name);
    Simulation simulation = simulationOf(device(), hair);
    ASSERT_TRUE(fallsAsleep(simulation));
    const HairState asleep = *simulation.state();
    for (int frame = 0; frame < 3; ++frame) ASSERT_TRUE(simulation.stepFrame(stillPoses(hair.settings)));
    EXPECT_TRUE(sleeps(simulation));
    EXPECT_TRUE(*simulation.positions() == asleep.positions);
    EXPECT_TRUE(simulation.state()->velocities == asleep.velocities);
  }
}

TEST_F(Sleep, OnlyWhereAskedForAndSlowEnough) {
  Hair hair = hairs()[0];
  for (const double speed : {0.0, 1e-12}) {
    hair.settings.sleepSpeed = speed;
    Simulation simulation = simulationOf(device(), hair);
    ASSERT_TRUE(simulation.stepFrame(HeadPose{{0.02, 0, 0}, {}}));
    const HeadPose there{{0.02, 0, 0}, {}};
    for (int frame = 0; frame < 20; ++frame) {
      ASSERT_TRUE(simulation.stepFrame(there));
      EXPECT_FALSE(sleeps(simulation)) << speed << ", frame " << frame;
    }
  }
}

// Every frame of a head that moves has its steps, also where hair rests on it, seen from the head.
TEST_F(Sleep, NotOnAHeadThatMoves) {
  for (const Hair& hair : sleepyHairs()) {
    if (hair.settings.air.on) continue;  // the air moves it
    SCOPED_TRACE(hair.name);
    Simulation simulation = simulationOf(device(), hair);
    for (int frame = 1; frame <= 20; ++frame) {
      ASSERT_TRUE(simulation.stepFrame(HeadPose{{1e-5 * frame, 0, 0}, {}}));
      EXPECT_FALSE(sleeps(simulation)) << frame;
    }
  }
}

struct Waker {
  const char* name;
  std::function<bool(const Hair&)> concerns;
  std::function<Status(Simulation&, const Hair&)> wake;  // before the next frame
};

const auto kAny = [](const Hair&) { return true; };
const std::vector<Waker> kWakers{
    {"settings", kAny,
     [](Simulation& s, const Hair& hair) {
       Settings other = hair.settings;
       other.gravity = {3, -9, 0};
       return s.setSettings(other);
     }},
    {"material", kAny,
     [](Simulation& s, const Hair&) {
       Material soft = varyingMaterial();
       soft.bendStiffness /= 3;
       return s.setMaterial(soft);
     }},
    {"bodies", [](const Hair& hair) { return !hair.bodies.empty(); },
     [](Simulation& s, const Hair&) { return s.setBodies({}); }},
    {"forces", [](const Hair& hair) { return hair.kernel.features.forces; },
     [](Simulation& s, const Hair& hair) {
       return s.setForces(std::vector<Vec3f>(hair.groom.points.size(), Vec3f{5, 0, 0}));
     }},
    {"state", kAny,
     [](Simulation& s, const Hair&) {
       HairState state = *s.state();
       for (Vec3f& v : state.velocities) v = {0.2f, 0, 0};
       return s.setState(state);
     }},
};

// Whatever changes wakes it in the next frame, and it goes on as hair that never slept: the same bits as of
// hair put where it is then.
TEST_F(Sleep, WhateverChangesWakesIt) {
  for (const Hair& hair : sleepyHairs()) {
    for (const Waker& waker : kWakers) {
      if (!waker.concerns(hair)) continue;
      SCOPED_TRACE(std::string(hair.name) + ", " + waker.name);
      Simulation simulation = simulationOf(device(), hair);
      ASSERT_TRUE(fallsAsleep(simulation));
      const std::vector<Vec3f> before = *simulation.positions();
      const Status woken = waker.wake(simulation, hair);
      ASSERT_TRUE(woken) << woken.error().message;
      ASSERT_TRUE(simulation.stepFrame(stillPoses(hair.settings)));
      EXPECT_FALSE(sleeps(simulation));
      EXPECT_FALSE(*simulation.positions() == before);
    }
  }
}

TEST_F(Sleep, NumbersThatAreNoOthersLetItSleep) {
  for (const Hair& hair : sleepyHairs()) {
    SCOPED_TRACE(hair.name);
    Simulation simulation = simulationOf(device(), hair);
    ASSERT_TRUE(fallsAsleep(simulation));
    ASSERT_TRUE(simulation.setSettings(simulation.settings()) &&
                simulation.setMaterial(simulation.material()));
    ASSERT_TRUE(simulation.stepFrame(stillPoses(hair.settings)));
    EXPECT_TRUE(sleeps(simulation));
  }
}

TEST_F(Sleep, HeadBodiesAndRootsWakeIt) {
  for (const Hair& hair : sleepyHairs()) {
    SCOPED_TRACE(hair.name);
    const auto awake = [&](std::span<const HeadPose> heads, std::span<const BodyPose> bodies,
                           std::span<const BodyPose> roots) {
      Simulation simulation = simulationOf(device(), hair);
      EXPECT_TRUE(fallsAsleep(simulation));
      EXPECT_TRUE(simulation.stepFrame(heads, bodies, roots));
      return !sleeps(simulation);
    };
    const std::vector<HeadPose> still = stillPoses(hair.settings);
    const auto steps = still.size();
    EXPECT_FALSE(awake(still, {}, {}));
    for (std::size_t moved = 0; moved < steps; moved += steps - 1) {
      std::vector<HeadPose> heads = still;
      heads[moved].position.x = 1e-4;
      EXPECT_TRUE(awake(heads, {}, {})) << moved;
      heads = still;
      heads[moved].rotation = fromRotationVector(Vec3d{0, 1e-4, 0});
      EXPECT_TRUE(awake(heads, {}, {})) << moved;
      if (!hair.bodies.empty()) {
        std::vector<BodyPose> bodies;
        for (std::size_t k = 0; k < steps; ++k)
          for (const Body& body : hair.bodies) bodies.push_back(body.poseAt(0, {}));
        EXPECT_FALSE(awake(still, bodies, {}));
        bodies[moved * hair.bodies.size() + 1].position.y += 1e-4;
        EXPECT_TRUE(awake(still, bodies, {})) << moved;
      }
      if (hair.kernel.features.roots) {
        std::vector<BodyPose> roots(steps * hair.groom.strandCount());
        EXPECT_FALSE(awake(still, {}, roots));
        roots[moved * hair.groom.strandCount() + 2].position.z = 1e-4;
        EXPECT_TRUE(awake(still, {}, roots)) << moved;
      }
    }
  }
}

// Wind that swells, or has eddies, never lets hair sleep; even wind does.
TEST_F(Sleep, WindThatChangesKeepsItAwake) {
  Hair hair = hairs()[0];
  hair.settings.sleepSpeed = 1;  // faster than any of it
  for (const bool gusts : {false, true}) {
    for (const bool eddies : {false, true}) {
      hair.settings.air = {
          .on = true, .wind = {0.1, 0, 0}, .gust = gusts ? 0.5 : 0, .turbulence = eddies ? 0.1 : 0};
      Simulation simulation = simulationOf(device(), hair);
      EXPECT_EQ(fallsAsleep(simulation, 20), !gusts && !eddies) << gusts << eddies;
    }
  }
}

// In flight, and through a checkpoint, it falls asleep in the same frame, with the same bits.
TEST_F(Sleep, TheSameHoweverFramesAreStepped) {
  for (const Hair& hair : sleepyHairs()) {
    SCOPED_TRACE(hair.name);
    Simulation one = simulationOf(device(), hair), flies = simulationOf(device(), hair),
               kept = simulationOf(device(), hair);
    const std::vector<HeadPose> poses = stillPoses(hair.settings);
    std::vector<bool> asleepOne, asleepFlies, asleepKept;
    for (int frame = 0; frame < 40; ++frame) {
      std::vector<HeadPose> now = poses;
      if (frame == 0) now.back().position.x = 0.001;
      if (frame > 0) now.assign(now.size(), HeadPose{{0.001, 0, 0}, {}});
      ASSERT_TRUE(one.stepFrame(now));
      asleepOne.push_back(sleeps(one));
      if (frame > 0) {
        ASSERT_TRUE(flies.waitFrame());
      }
      ASSERT_TRUE(flies.submitFrame(now));
      asleepFlies.push_back(sleeps(flies));
      if (frame % 5 == 4) {
        const auto checkpoint = kept.checkpoint();
        ASSERT_TRUE(checkpoint);
        kept = simulationOf(device(), hair);
        ASSERT_TRUE(kept.restore(*checkpoint));
      }
      const Status stepped = kept.stepFrame(now);
      ASSERT_TRUE(stepped) << stepped.error().message;
      asleepKept.push_back(sleeps(kept));
    }
    ASSERT_TRUE(flies.waitFrame());
    EXPECT_EQ(asleepFlies, asleepOne);
    EXPECT_EQ(asleepKept, asleepOne);
    EXPECT_TRUE(asleepOne.back());
    EXPECT_TRUE(*flies.positions() == *one.positions());
    EXPECT_TRUE(*kept.positions() == *one.positions());
  }
}

}  // namespace
}  // namespace ringlet::test::sleep_test
