// Hair that meets as a volume on the device against the double reference, by itself and beside contacts
// between pairs; and that nothing is left to threads, to how much room lists have, or to what went before.
// Mirrors shaders/kernels/volume_begin.comp to volume_spread.comp.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "parity/contacts.h"
#include "reference/step.h"
#include "ringlet/groom/generate.h"
#include "ringlet/solver/diagnostics.h"
#include "tests/support/gpu_test.h"
#include "tests/support/parity.h"
#include "tests/support/test_support.h"
#include "tests/support/tolerances.h"

namespace ringlet::test::volume_step_test {
namespace {

using namespace parity;

Settings volumeSettings() {
  Settings settings = meetingSettings();
  settings.contacts.method = ContactMethod::volume;
  return settings;
}

Settings besideSettings() {
  Settings settings = meetingSettings();
  settings.contacts.method = ContactMethod::automatic;
  return settings;
}
HeadPose shaken(int frame, double amplitude) {
  return {{amplitude * std::sin(0.7 * frame), 0, 0}, fromRotationVector(Vec3d{0, 0.05 * frame, 0})};
}

using Hair = std::pair<std::vector<Vec3f>, std::vector<Vec3f>>;
Hair hairOf(const Simulation& simulation) {
  auto state = simulation.state();
  EXPECT_TRUE(state) << state.error().message;
  return {state->positions, state->velocities};
}

class VolumeStep : public GpuTest {
 protected:
  // Frames `begin` + 1 to `end` of the shaken head.
  static void shake(Simulation& simulation, int begin, int end, double amplitude = 0.03) {
    for (int frame = begin + 1; frame <= end; ++frame) {
      const Status stepped = simulation.stepFrame(shaken(frame, amplitude));
      EXPECT_TRUE(stepped) << stepped.error().message;
    }
  }
};

// One and two lanes solve from the strand's ends; two of 24 are not filled.
TEST_F(VolumeStep, FramesAgreeWithDouble) {
  for (const KernelChoice& kernel :
       {KernelChoice{}, KernelChoice{.particlesPerLane = 8}, KernelChoice{.particlesPerLane = 32, .lanes = 1},
        KernelChoice{.particlesPerLane = 16, .lanes = 2}, KernelChoice{.particlesPerLane = 24, .lanes = 2},
        KernelChoice{KernelChoice::Form::memory, 20, 2}, KernelChoice{KernelChoice::Form::memory, 9, 4},
        KernelChoice{KernelChoice::Form::serial}}) {
    for (const int iterations : {1, 2, 3}) {
      Settings settings = volumeSettings();
      settings.contacts.iterations = iterations;
      double momentum = 0, expected = 0;
      const auto worst =
          shakenError(device(), denseSwatch(32), settings, kernel, 12,
                      [&](const Simulation& simulation, const reference::Simulation<double>& reference) {
                        momentum = simulation.contactReport()->momentumError;
                        expected = reference.report().freeMomentumError;
                      });
      ASSERT_TRUE(worst) << worst.error().message;
      fmt::print("{} iterations: {:.1e} m apart, momentum error {:.4f}\n", iterations, *worst, momentum);
      EXPECT_LE(*worst, kMeetingMetres);
      EXPECT_NEAR(momentum, expected, 1e-4);
    }
  }
}

// However stiff, however fast the head, and while settings change: the sums have room for all of it, and
// frames are the reference's, which cuts nothing.
TEST_F(VolumeStep, SumsHaveRoomAtAnySettings) {
  struct Case {
    const char* name;
    double drag = 600, stiffness = 1e6, memory = 0.3, amplitude = 0.03;
    int steps = 8;
    bool changes = false;
  };
  for (const Case& c :
       {Case{.name = "default"}, Case{.name = "stiff", .stiffness = 1e7},
        Case{.name = "drag alone", .drag = 1e5, .stiffness = 0}, Case{.name = "long memory", .memory = 1000},
        Case{.name = "many steps", .steps = 32}, Case{.name = "whip", .stiffness = 1e5, .amplitude = 0.4},
        Case{.name = "live", .changes = true}}) {
    SCOPED_TRACE(c.name);
    Settings settings = volumeSettings();
    settings.stepsPerFrame = c.steps;
    settings.contacts.volumeDrag = c.drag, settings.contacts.volumeStiffness = c.stiffness;
    settings.contacts.volumeMemorySeconds = c.memory;
    const Groom groom = denseSwatch(32);
    auto simulation = Simulation::create(device(), groom, {}, settings);
    ASSERT_TRUE(simulation) << simulation.error().message;
    reference::Simulation<double> reference(groom, {}, settings);
    HeadPose before;
    double worst = 0;
    for (int frame = 1; frame <= 8; ++frame) {
      if (c.changes && frame == 5) {
        settings.contacts.volumeStiffness = 3e6, settings.contacts.volumeDrag = 3e3;
        ASSERT_TRUE(simulation->setSettings(settings));
        reference.change(groom, {}, settings);
      }
      const HeadPose next = shaken(frame, c.amplitude);
      ASSERT_TRUE(simulation->stepFrame(next));
      std::vector<HeadPose> poses;
      for (int k = 1; k <= settings.stepsPerFrame; ++k)
        poses.push_back(interpolate(before, next, double(k) / settings.stepsPerFrame));
      reference.stepFrame(poses);
      before = next;
      const auto positions = hairOf(*simulation).first;
      for (std::size_t i = 0; i < positions.size(); ++i)
        worst = std::max(worst, (reference::toEigen<double>(positions[i]) - reference.positions()[i]).norm());
    }
    const auto report = *simulation->contactReport();
    fmt::print("{}: {:.1e} m apart, {:.3f} of the room\n", c.name, worst, report.volumeLargest);
    EXPECT_LE(worst, kMeetingMetres);
    EXPECT_EQ(report.volumeCut, 0u);
    EXPECT_GT(report.volumeLargest, 0);
  }
}

// What was cut stays counted, wherever the hair is put.
TEST_F(VolumeStep, WhatIsCutIsCounted) {
  auto simulation =
      Simulation::create(device(), denseSwatch(32), {}, volumeSettings(), {}, {.volumeRange = 1.0 / 1024});
  ASSERT_TRUE(simulation) << simulation.error().message;
  shake(*simulation, 0, 4);
  const ContactReport before = *simulation->contactReport();
  EXPECT_GT(before.volumeCut, 0u);
  EXPECT_GT(before.volumeLargest, 1);
  EXPECT_EQ(before.warnings().size(), 1u);
  ASSERT_TRUE(simulation->setState(*simulation->state()));
  const ContactReport after = *simulation->contactReport();
  EXPECT_EQ(after.volumeCut, before.volumeCut);
  EXPECT_EQ(after.volumeLargest, before.volumeLargest);
}

// As a volume strands that meet keep further from each other's ways than without: it does something.
TEST_F(VolumeStep, HoldsStrandsTogether) {
  const auto run = [&](bool on) {
    Settings settings = volumeSettings();
    settings.contacts.on = on;
    auto simulation = Simulation::create(device(), denseSwatch(32), {}, settings);
    EXPECT_TRUE(simulation) << simulation.error().message;
    shake(*simulation, 0, 12);
    return hairOf(*simulation).first;
  };
  const auto with = run(true), without = run(false);
  EXPECT_GT(farthestApart(with, without), 0.001);
}

TEST_F(VolumeStep, BesideContactsAgreesWithDouble) {
  const Groom groom = bunchAndStrands();
  // With the smaller radius strands come near the bunch, leave and come again: its lists are empty between.
  for (const auto& [kernel, radius] : {std::pair{KernelChoice{}, 0.004},
                                       {KernelChoice{KernelChoice::Form::serial}, 0.004},
                                       {KernelChoice{}, 0.002}}) {
    Settings settings = besideSettings();
    settings.contacts.radius = radius;
    auto simulation = Simulation::create(device(), groom, {}, settings, {}, kernel);
    ASSERT_TRUE(simulation) << simulation.error().message;
    reference::Simulation<double> reference(groom, {}, settings);
    HeadPose before;
    double worst = 0;
    std::uint64_t met = 0;
    for (int frame = 1; frame <= 12; ++frame) {
      const HeadPose next = shaken(frame, 0.03);
      shake(*simulation, frame - 1, frame);
      std::vector<HeadPose> poses;
      for (int k = 1; k <= settings.stepsPerFrame; ++k)
        poses.push_back(interpolate(before, next, double(k) / settings.stepsPerFrame));
      reference.stepFrame(poses);
      before = next;
      const auto positions = hairOf(*simulation).first;
      for (std::size_t i = 0; i < positions.size(); ++i)
        worst = std::max(worst, (reference::toEigen<double>(positions[i]) - reference.positions()[i]).norm());
      const auto report = *simulation->contactReport();
      EXPECT_EQ(report.contacts, reference.report().contacts) << frame;
      EXPECT_EQ(report.volumeStrands, 60u);
      met += report.contacts;
    }
    fmt::print("{:.1e} m apart; {} contacts in all frames\n", worst, met);
    EXPECT_LE(worst, kMeetingMetres);
    EXPECT_GT(met, 10u) << "nothing meets pair by pair, and nothing is tested";
  }
}

TEST_F(VolumeStep, RepeatsBitwiseWithAnyNumberOfThreads) {
  const auto run = [](const ComputeDevice& on) {
    auto simulation = Simulation::create(on, bunchAndStrands(), {}, besideSettings());
    EXPECT_TRUE(simulation) << simulation.error().message;
    shake(*simulation, 0, 6);
    return hairOf(*simulation);
  };
  const Hair first = run(device());
  EXPECT_EQ(first, run(device()));
  // lavapipe reads its number of threads when a device is opened; others take no notice.
  for (const char* threads : {"1", "2"}) {
    ::setenv("LP_NUM_THREADS", threads, 1);
    const auto other = ComputeDevice::open();
    ASSERT_TRUE(other) << other.error().message;
    EXPECT_EQ(first, run(*other)) << threads << " threads";
  }
  ::unsetenv("LP_NUM_THREADS");
}

// A frame that stops because lists are too short begins its step once more, and the volume with it.
TEST_F(VolumeStep, RoomOfListsDecidesNothing) {
  const Groom groom = bunchAndStrands();
  const auto run = [&](int room) {
    auto simulation = Simulation::create(device(), groom, {}, besideSettings(), {}, {.contactRoom = room});
    EXPECT_TRUE(simulation) << simulation.error().message;
    const std::uint64_t before = Diagnostics(*simulation).memory().contactLists;
    HairState state = *simulation->state();
    for (std::size_t s = 60; s < 64; ++s) {  // into the bunch, so fast that they may meet all of it
      for (std::size_t i = groom.firstPoint[s] + 1; i < groom.firstPoint[s + 1]; ++i) {
        state.positions[i] = state.positions[i] + Vec3f{0.03f, 0, 0};
        state.velocities[i] = {5, 0, 0};
      }
    }
    EXPECT_TRUE(simulation->setState(state));
    shake(*simulation, 0, 4);
    return std::tuple(hairOf(*simulation), Diagnostics(*simulation).memory().contactLists > before,
                      simulation->contactReport()->rebuilds);
  };
  const auto [one, grew, rebuilds] = run(1);
  EXPECT_TRUE(grew) << "all had room, and nothing is tested";
  for (const int room : {2, 16}) {
    const auto [other, otherGrew, otherRebuilds] = run(room);
    EXPECT_EQ(one, other) << "room x " << room;
    EXPECT_EQ(rebuilds, otherRebuilds) << "room x " << room;
  }
}

// Cells are sorted every second step of the run, whatever frames are made of: one frame of 6 steps, two of 3,
// six of 1.
TEST_F(VolumeStep, HoweverARunIsCutIntoFrames) {
  std::vector<Hair> ends;
  for (const int steps : {6, 3, 1}) {
    Settings settings = volumeSettings();
    settings.stepsPerFrame = steps;
    settings.framesPerSecond = 192.0 / steps;
    auto simulation = Simulation::create(device(), denseSwatch(32), {}, settings);
    ASSERT_TRUE(simulation) << simulation.error().message;
    for (int done = 0; done < 18; done += steps) {
      std::vector<HeadPose> poses;
      for (int k = 1; k <= steps; ++k) poses.push_back(shaken(1, 0.002 * (done + k)));
      ASSERT_TRUE(simulation->stepFrame(poses));
    }
    ends.push_back(hairOf(*simulation));
  }
  EXPECT_EQ(ends[0], ends[1]);
  EXPECT_EQ(ends[0], ends[2]);
}

// Without drag and stiffness a volume does nothing, and divides by nothing.
TEST_F(VolumeStep, MayDoNothing) {
  std::vector<Hair> ends;
  for (const bool on : {false, true}) {
    Settings settings = volumeSettings();
    settings.contacts.on = on;
    settings.contacts.volumeDrag = settings.contacts.volumeStiffness = 0;
    auto simulation = Simulation::create(device(), denseSwatch(32), {}, settings);
    ASSERT_TRUE(simulation) << simulation.error().message;
    shake(*simulation, 0, 4);
    EXPECT_EQ(simulation->report()->nonfinite, 0u);
    ends.push_back(hairOf(*simulation));
  }
  EXPECT_LE(farthestApart(ends[0].first, ends[1].first), kMeetingMetres);  // another order of sums
}

// What is put somewhere begins anew: as hair that never was anywhere else.
TEST_F(VolumeStep, StatesThatArePutForgetDisplacements) {
  Settings settings = volumeSettings();
  settings.stepsPerFrame = 7;  // with an odd number frames end between two sorts
  auto moved = Simulation::create(device(), denseSwatch(32), {}, settings);
  ASSERT_TRUE(moved) << moved.error().message;
  shake(*moved, 0, 5);
  const auto state = moved->state();
  ASSERT_TRUE(state) << state.error().message;
  const HeadPose there = shaken(5, 0.03), step = interpolate(shaken(4, 0.03), there, 6.0 / 7);
  auto anew =
      Simulation::create(device(), denseSwatch(32), {}, settings, {.head = there, .oneStepEarlier = step});
  ASSERT_TRUE(anew) << anew.error().message;
  ASSERT_TRUE(anew->setState(*state));
  auto kept =
      Simulation::create(device(), denseSwatch(32), {}, settings, {.head = there, .oneStepEarlier = step});
  ASSERT_TRUE(kept) << kept.error().message;
  shake(*kept, 0, 3);  // somewhere else
  shake(*kept, 3, 5);
  ASSERT_TRUE(kept->setState(*state));
  shake(*anew, 5, 7);
  shake(*kept, 5, 7);
  EXPECT_EQ(hairOf(*anew), hairOf(*kept));
}

// More cells than there is room for: they grow until they fit, and nothing is lost.
// More particles in one cell than a loop may have turns.
TEST_F(VolumeStep, MoreThanADeviceCanLookThroughIsAnError) {
  if (!device().limits().endsLoopsEarly) GTEST_SKIP() << "this device does not end loops early";
  SwatchParameters parameters;
  parameters.curl.particleCount = 4;
  parameters.columnCount = 500, parameters.rowCount = 280;
  parameters.spacing = 0.0005;
  Settings settings = volumeSettings();
  settings.contacts.volumeCell = 5;
  auto simulation = Simulation::create(device(), *makeSwatch(parameters), {}, settings);
  ASSERT_TRUE(simulation) << simulation.error().message;
  const Status stepped = simulation->stepFrame(shaken(1, 0.01));
  ASSERT_FALSE(stepped);
  EXPECT_NE(stepped.error().message.find("more contact particles are near one another"), std::string::npos)
      << stepped.error().message;
}

TEST_F(VolumeStep, TooManyCellsBecomeLarger) {
  Settings settings = volumeSettings();
  settings.contacts.volumeCell = 1e-4;
  auto simulation = Simulation::create(device(), denseSwatch(32), {}, settings);
  ASSERT_TRUE(simulation) << simulation.error().message;
  shake(*simulation, 0, 4);
  EXPECT_EQ(simulation->report()->nonfinite, 0u);
  EXPECT_LT(Diagnostics(*simulation).memory().volume, 100u << 20);
  const ContactReport report = *simulation->contactReport();
  EXPECT_GE(report.volumeCoarsest, 2);
  ASSERT_EQ(report.warnings().size(), 1u);
  EXPECT_NE(report.warnings()[0].find("times as large"), std::string::npos) << report.warnings()[0];
}

// At rest nothing is displaced and nothing moves beside the head: a volume gives nothing.
TEST_F(VolumeStep, TheRestPoseStaysPut) {
  auto simulation = Simulation::create(device(), denseSwatch(48), {}, volumeSettings());
  ASSERT_TRUE(simulation) << simulation.error().message;
  const auto rest = *simulation->positions();
  for (int frame = 0; frame < 48; ++frame) ASSERT_TRUE(simulation->stepFrame(HeadPose{}));
  const double moved = farthestApart(*simulation->positions(), rest);
  fmt::print("moved {:.1e} m in 2 s\n", moved);
  EXPECT_LE(moved, kAtRest * 0.56);  // of the arc length
}

}  // namespace
}  // namespace ringlet::test::volume_step_test
