// Frames in flight give the bits of frames one by one, with everything the host writes anew for each; and
// those are the reference's frames.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "reference/step.h"
#include "ringlet/scene/motion.h"
#include "ringlet/scenes/builtin_scene.h"
#include "ringlet/solver/simulation.h"
#include "tests/support/gpu_test.h"
#include "tests/support/parity.h"
#include "tests/support/tolerances.h"

namespace ringlet::test::frames_in_flight_test {
namespace {

// What a frame is told.
struct Told {
  std::vector<HeadPose> heads;
  std::vector<BodyPose> bodies{}, roots{};
};

struct Cast {
  Groom groom;
  Material material{};
  Settings settings{};
  std::vector<Body> bodies{};
  std::vector<Vec3d> rootShifts{};
  bool movingRoots = false;
  HeadPose start{};
  std::vector<Told> frames{};
};

struct Seen {
  std::vector<std::vector<Vec3f>> frames;
  HairState state;
  SimulationReport report;
  ContactReport contacts;
};

class FramesInFlight : public GpuTest {
 protected:
  Simulation make(const Cast& cast) {
    auto simulation =
        Simulation::create(device(), cast.groom, cast.material, cast.settings,
                           {.head = cast.start, .bodies = cast.bodies, .rootShifts = cast.rootShifts},
                           {.features = {.roots = cast.movingRoots}});
    EXPECT_TRUE(simulation) << simulation.error().message;
    return std::move(*simulation);
  }

  static Seen atEnd(Simulation& simulation, std::vector<std::vector<Vec3f>> frames) {
    return {std::move(frames), *simulation.state(), *simulation.report(), *simulation.contactReport()};
  }

  Seen oneByOne(const Cast& cast) {
    Simulation simulation = make(cast);
    std::vector<std::vector<Vec3f>> frames;
    for (const Told& frame : cast.frames) {
      EXPECT_TRUE(simulation.stepFrame(frame.heads, frame.bodies, frame.roots));
      frames.push_back(*simulation.positions());
    }
    return atEnd(simulation, std::move(frames));
  }

  // As many at a time as there may be.
  Seen inFlight(const Cast& cast) {
    Simulation simulation = make(cast);
    std::vector<std::vector<Vec3f>> frames;
    std::size_t submitted = 0;
    while (frames.size() < cast.frames.size()) {
      if (submitted < cast.frames.size() && submitted - frames.size() < Simulation::kFramesInFlight) {
        const Told& frame = cast.frames[submitted++];
        EXPECT_TRUE(simulation.submitFrame(frame.heads, frame.bodies, frame.roots));
        continue;
      }
      EXPECT_TRUE(simulation.waitFrame());
      frames.push_back(simulation.framePositions());
      EXPECT_TRUE(std::ranges::equal(simulation.frameView(), frames.back()));
    }
    return atEnd(simulation, std::move(frames));
  }

  Seen expectSameBits(const Cast& cast) {
    const Seen one = oneByOne(cast), many = inFlight(cast);
    EXPECT_EQ(one.frames.size(), cast.frames.size());
    for (std::size_t frame = 0; frame < one.frames.size(); ++frame)
      EXPECT_TRUE(one.frames[frame] == many.frames[frame]) << "frame " << frame;
    EXPECT_TRUE(one.frames.back() == one.state.positions) << "the last frame's are those of now";
    EXPECT_TRUE(one.state.positions == many.state.positions);
    EXPECT_TRUE(one.state.velocities == many.state.velocities);
    EXPECT_EQ(one.report.maxEdgeStretch, many.report.maxEdgeStretch);
    EXPECT_EQ(one.report.limitedShare, many.report.limitedShare);
    EXPECT_EQ(one.contacts.pairTests, many.contacts.pairTests);
    EXPECT_EQ(one.contacts.rebuilds, many.contacts.rebuilds);
    EXPECT_EQ(one.contacts.contacts, many.contacts.contacts);
    return many;
  }

  // The first frames, each particle within `tolerance` [m] of the reference in double, and what the reference
  // in float is off in the frames so far: where hair meets hair, rounding grows.
  static void expectReference(const Cast& cast, const Seen& seen, std::size_t frameCount, double tolerance) {
    reference::Simulation<double> exact(cast.groom, cast.material, cast.settings, cast.start, cast.start, {},
                                        cast.bodies);
    reference::Simulation<float> rounded(cast.groom, cast.material, cast.settings, cast.start, cast.start, {},
                                         cast.bodies);
    if (!cast.rootShifts.empty())
      exact.setRootShifts(cast.rootShifts), rounded.setRootShifts(cast.rootShifts);
    double worst = 0, rounding = 0;
    for (std::size_t frame = 0; frame < frameCount; ++frame) {
      const Told& told = cast.frames[frame];
      exact.stepFrame(told.heads, told.bodies, told.roots);
      rounded.stepFrame(told.heads, told.bodies, told.roots);
      for (std::size_t i = 0; i < cast.groom.points.size(); ++i) {
        const Eigen::Vector3d expected = exact.positions()[i];
        worst = std::max(worst, (reference::toEigen<double>(seen.frames[frame][i]) - expected).norm());
        rounding = std::max(rounding, (rounded.positions()[i].cast<double>() - expected).norm());
      }
      EXPECT_LE(worst, tolerance + rounding) << "frame " << frame;
    }
    fmt::print("after {} frames {:.1e} m from the reference in double, that in float {:.1e} m\n", frameCount,
               worst, rounding);
  }

  static std::vector<HeadPose> headsOf(const Motion& motion, const Settings& settings, int frame) {
    std::vector<HeadPose> heads;
    for (int k = 1; k <= settings.stepsPerFrame; ++k)
      heads.push_back(motion.poseAt((frame * settings.stepsPerFrame + k) * settings.stepSeconds()));
    return heads;
  }
};

TEST_F(FramesInFlight, ShakenHair) {
  Cast cast{randomGroom({64, 2, 100, 31}, 9)};  // the device has another order
  const Motion motion = *motionByName("shake", {0, 1, 0});
  for (int frame = 0; frame < 24; ++frame) cast.frames.push_back({headsOf(motion, cast.settings, frame)});
  expectReference(cast, expectSameBits(cast), 24, kOneSecond * 0.25);  // of the arc length
}

// Bodies, air and roots that move, and a head that jumps and turns in the middle.
TEST_F(FramesInFlight, EverythingThatChangesFromFrameToFrame) {
  Cast cast{randomGroom({31, 20, 31}, 5)};  // one kernel
  cast.settings.air.on = true;
  cast.settings.air.wind = {2, 0, 1};
  cast.settings.air.turbulence = 1;
  cast.bodies = {{.name = "ball", .radius = 0.03}};
  cast.movingRoots = true;
  Motion motion = *motionByName("nod", {0, 1, 0});
  constexpr int kJump = 7;
  for (int frame = 0; frame < 16; ++frame) {
    Told told{headsOf(motion, cast.settings, frame)};
    for (std::size_t k = 0; k < told.heads.size(); ++k) {
      HeadPose& head = told.heads[k];
      const double t = frame + double(k) / 8;
      if (frame >= kJump) {
        head.position += Vec3d{3, 0, 0};
        head.rotation = normalized(head.rotation * Quatd{0, std::sin(0.4), 0, std::cos(0.4)});
      }
      told.bodies.push_back({head.position + Vec3d{0.05 * std::sin(t), -0.1, 0}, Quatd{}});
      for (std::size_t s = 0; s < cast.groom.strandCount(); ++s)
        told.roots.push_back({{0.001 * std::sin(0.3 * t), 0, 0}, Quatd{}});
    }
    cast.frames.push_back(std::move(told));
  }
  const Seen seen = expectSameBits(cast);
  for (std::size_t i = 0; i < 31; ++i)
    EXPECT_FALSE(seen.frames[kJump][i] == seen.frames[kJump - 1][i])
        << "the jump turned hair, particle " << i;
}

// Two swatches pressed into each other: lists grow in the middle of frames, which then go on.
TEST_F(FramesInFlight, HairThatMeetsHair) {
  auto scene = makeScene("pile", {.particles = 16, .strands = 6, .seconds = 1.5});
  ASSERT_TRUE(scene) << scene.error().message;
  Cast cast{scene->groom, scene->material, scene->settings, {}, scene->rootShifts};
  cast.start = scene->motion.poseAt(0);
  for (int frame = 0; frame < scene->frameCount; ++frame)
    cast.frames.push_back({headsOf(scene->motion, cast.settings, frame)});
  const Seen seen = expectSameBits(cast);
  expectReference(cast, seen, 6, kMeetingMetres);
  EXPECT_GT(seen.contacts.contacts, 0u);
  EXPECT_GT(seen.contacts.rebuilds, 1u);
}

// All that is asked in between waits for what is in flight, and leaves it to be taken.
TEST_F(FramesInFlight, QuestionsWaitForThem) {
  Cast cast{randomGroom({31, 20}, 2)};
  const Motion motion = *motionByName("shake", {0, 1, 0});
  for (int frame = 0; frame < 2; ++frame) cast.frames.push_back({headsOf(motion, cast.settings, frame)});
  const Seen one = oneByOne(cast);

  Simulation simulation = make(cast);
  for (const Told& frame : cast.frames) ASSERT_TRUE(simulation.submitFrame(frame.heads));
  EXPECT_TRUE(*simulation.positions() == one.frames[1]);
  EXPECT_EQ(simulation.report()->maxEdgeStretch, one.report.maxEdgeStretch);
  for (const auto& expected : one.frames) {
    ASSERT_TRUE(simulation.waitFrame());
    EXPECT_TRUE(simulation.framePositions() == expected);
  }

  // What is put there is what positions() then says, whatever a frame brought back.
  const HairState other = randomState(cast.groom, cast.settings, 2);
  ASSERT_TRUE(simulation.setState(other));
  EXPECT_TRUE(*simulation.positions() == other.positions);
}

// Nobody waits for the last frames: the device is left in peace before its buffers go.
TEST_F(FramesInFlight, MayBeLeftInFlight) {
  Cast cast{randomGroom({31, 31, 31}, 2)};
  Simulation simulation = make(cast);
  const std::vector<HeadPose> heads(static_cast<std::size_t>(cast.settings.stepsPerFrame));
  for (std::size_t frame = 0; frame < Simulation::kFramesInFlight; ++frame)
    EXPECT_TRUE(simulation.submitFrame(heads));
}

}  // namespace
}  // namespace ringlet::test::frames_in_flight_test
