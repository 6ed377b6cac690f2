// Settings that change while hair moves: each does what it does from the start, and what may not change says
// so.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "ringlet/scene/settings_fields.h"
#include "ringlet/solver/diagnostics.h"
#include "tests/kernels/sample_hairs.h"
#include "tests/support/gpu_test.h"

namespace ringlet::test::live_settings_test {
namespace {

using LiveSettings = GpuTest;

struct Change {
  std::string name;
  std::function<void(Settings&)> make;
};

template <class Owner>
void addFieldChanges(std::vector<Change>& changes, std::span<const SettingField<Owner>> fields,
                     Owner Settings::*owner) {
  for (const SettingField<Owner>& field : fields) {
    if (!field.isLive) continue;
    changes.push_back({field.key, [&field, owner](Settings& settings) {
                         std::visit(
                             [&](auto member) {
                               auto& value = settings.*owner.*member;
                               using Value = std::remove_cvref_t<decltype(value)>;
                               if constexpr (std::is_same_v<Value, double>) value = 0.3 + 0.5 * value;
                               if constexpr (std::is_same_v<Value, Vec3d>) value = Vec3d{2, 0.5, 1};
                               if constexpr (std::is_same_v<Value, std::optional<int>>) value = 3;
                             },
                             field.member);
                       }});
  }
}

// All that may change and that the integrator jacobi feels.
std::vector<Change> liveChanges() {
  std::vector<Change> changes{
      {"gravity",
       [](Settings& s) {
         s.gravity = {3, -2, 1};
       }},
      {"maxStretch", [](Settings& s) { s.maxStretch = 1.01; }},
      {"steps", [](Settings& s) { s.stepsPerFrame = 4, s.framesPerSecond = 48; }},
      {"shorter steps", [](Settings& s) { s.framesPerSecond = 40; }},
  };
  addFieldChanges(changes, contactFields(), &Settings::contacts);
  addFieldChanges(changes, airFields(), &Settings::air);
  return changes;
}

Settings changed(const Settings& settings, const Change& change) {
  Settings other = settings;
  change.make(other);
  return other;
}

// Hair that knows of everything, on a head that turns.
std::vector<Hair> hairsThatChange() {
  std::vector<Hair> all = hairs();
  Hair time = *std::ranges::find(all, std::string("pairs"), &Hair::name);
  time.name = "pairs, time taper";
  time.settings.contacts.taper = ContactTaper::time;
  all.push_back(time);
  for (Hair& hair : all) {
    if (hair.settings.air.on) hair.settings.air.wind = {1, 0, 0}, hair.settings.air.gust = 0.5;
  }
  return all;
}

HeadPose headAt(double t) { return {Vec3d{2 * t, 0, 0}, fromRotationVector(Vec3d{0, 4 * t, 0})}; }

// Frames of a length that the settings say, from t on; poses at the same times whatever the steps.
double step(Simulation& simulation, double t, int frames) {
  for (int frame = 0; frame < frames; ++frame) {
    const Settings& s = simulation.settings();
    std::vector<HeadPose> poses;
    for (int k = 1; k <= s.stepsPerFrame; ++k) poses.push_back(headAt(t + k * s.stepSeconds()));
    EXPECT_TRUE(simulation.stepFrame(poses));
    t += 1 / s.framesPerSecond;
  }
  return t;
}

Result<Simulation> born(const ComputeDevice& device, const Hair& hair, const Settings& settings) {
  return Simulation::create(
      device, hair.groom, varyingMaterial(), settings,
      {.head = headAt(0), .oneStepEarlier = headAt(-settings.stepSeconds()), .bodies = hair.bodies},
      hair.kernel);
}

// Before the first frame: the same bits as hair that was made so. Steps' lengths are in the asset's constants
// (how stiff the core may be), so there it is what the change alone does that is compared.
TEST_F(LiveSettings, DoWhatTheyDoFromTheStart) {
  std::vector<std::string> felt;
  for (const Hair& hair : hairsThatChange()) {
    const auto plain = born(device(), hair, hair.settings);
    ASSERT_TRUE(plain) << plain.error().message;
    Simulation unchanged = *born(device(), hair, hair.settings);
    step(unchanged, 0, 3);
    for (const Change& change : liveChanges()) {
      SCOPED_TRACE(std::string(hair.name) + ", " + change.name);
      const Settings settings = changed(hair.settings, change);
      const bool sameSteps = std::abs(settings.stepSeconds() / hair.settings.stepSeconds() - 1) < 1e-12;
      Simulation late = *born(device(), hair, hair.settings);
      const Status status = late.setSettings(settings);
      ASSERT_TRUE(status) << status.error().message;
      EXPECT_EQ(late.settings().gravity, settings.gravity);
      step(late, 0, 3);
      if (!(late.state()->positions == unchanged.state()->positions)) felt.push_back(change.name);
      if (!sameSteps || change.name == "gravity") continue;  // the rest pose is balanced against gravity
      Simulation early = *born(device(), hair, settings);
      step(early, 0, 3);
      EXPECT_TRUE(late.state()->positions == early.state()->positions);
      EXPECT_TRUE(late.state()->velocities == early.state()->velocities);
    }
  }
  for (const Change& change : liveChanges())
    EXPECT_TRUE(std::ranges::find(felt, change.name) != felt.end()) << change.name << " changes nothing";
}

// From the next frame on, whatever is under way; and hair without contacts keeps two frames in flight.
TEST_F(LiveSettings, ChangeBetweenFrames) {
  for (const Hair& hair : hairsThatChange()) {
    SCOPED_TRACE(hair.name);
    Settings light = hair.settings;
    light.gravity = {0, 2, 0};
    Simulation waits = *born(device(), hair, hair.settings), flies = *born(device(), hair, hair.settings);
    step(waits, 0, 1);
    ASSERT_TRUE(waits.setSettings(light));
    step(waits, 1 / hair.settings.framesPerSecond, 1);
    const auto posesOf = [&](int frame) {
      std::vector<HeadPose> poses;
      for (int k = 1; k <= hair.settings.stepsPerFrame; ++k)
        poses.push_back(headAt(frame / hair.settings.framesPerSecond + k * hair.settings.stepSeconds()));
      return poses;
    };
    ASSERT_TRUE(flies.submitFrame(posesOf(0)));
    ASSERT_TRUE(flies.setSettings(light));
    ASSERT_TRUE(flies.submitFrame(posesOf(1)));
    ASSERT_TRUE(flies.waitFrame());
    ASSERT_TRUE(flies.waitFrame());
    EXPECT_TRUE(flies.state()->positions == waits.state()->positions);
  }
}

// Roots' own poses, where hair has them: they travel and turn evenly too.
std::vector<BodyPose> rootPosesOf(const Hair& hair, double t, const Settings& settings) {
  std::vector<BodyPose> poses;
  for (int k = 1; hair.kernel.features.roots && k <= settings.stepsPerFrame; ++k) {
    const double at = t + k * settings.stepSeconds();
    const BodyPose root{Vec3d{0, 2 * at, 0}, fromRotationVector(Vec3d{2 * at, 0, 0})};
    poses.insert(poses.end(), hair.groom.strandCount(), root);
  }
  return poses;
}

// Three times a 24th of a second; the middle one in steps half as long, or not.
std::vector<Vec3f> endOf(const ComputeDevice& device, const Hair& hair, bool changes) {
  Simulation simulation = *born(device, hair, hair.settings);
  Settings shorter = hair.settings;
  shorter.framesPerSecond *= 2;
  double t = 0;
  const std::vector<bool> even{false, false, false}, uneven{false, true, true, false};
  for (const bool isShort : changes ? uneven : even) {
    const Settings& settings = isShort ? shorter : hair.settings;
    EXPECT_TRUE(simulation.setSettings(settings));
    std::vector<HeadPose> poses;
    for (int k = 1; k <= settings.stepsPerFrame; ++k) poses.push_back(headAt(t + k * settings.stepSeconds()));
    EXPECT_TRUE(simulation.stepFrame(poses, {}, rootPosesOf(hair, t, settings)));
    t += 1 / settings.framesPerSecond;
  }
  return *simulation.positions();
}

// A head that turns evenly carries its hair through a change of steps: nothing is pushed. Where steps become
// half as long and speeds did not, hair would be centimetres away.
TEST_F(LiveSettings, ShorterStepsGoOnAsFast) {
  std::vector<Hair> all = hairsThatChange();
  std::erase_if(all, [](const Hair& hair) {  // these move hair by themselves
    return hair.settings.contacts.on || !hair.bodies.empty();
  });
  for (const Hair& hair : all) {
    SCOPED_TRACE(hair.name);
    const std::vector<Vec3f> even = endOf(device(), hair, false), uneven = endOf(device(), hair, true);
    double apart = 0;
    for (std::size_t i = 0; i < even.size(); ++i)
      apart = std::max<double>(apart, length(even[i] - uneven[i]));
    EXPECT_LT(apart, 2e-3);
    EXPECT_GT(apart, 1e-6) << "steps did not change";
  }
}

// Steps that become shorter and long again between two frames change nothing but last digits: gusts go on
// where they were, too.
TEST_F(LiveSettings, ToAndBackIsNothing) {
  for (Hair hair : hairsThatChange()) {
    SCOPED_TRACE(hair.name);
    if (hair.settings.air.on) hair.settings.air.gust = 3, hair.settings.air.gustSeconds = 0.1;
    Simulation changes = *born(device(), hair, hair.settings), stays = *born(device(), hair, hair.settings);
    double t = 0;
    for (int frame = 0; frame < 4; ++frame) {
      Settings shorter = hair.settings;
      shorter.framesPerSecond *= 3;
      ASSERT_TRUE(changes.setSettings(shorter));
      ASSERT_TRUE(changes.setSettings(hair.settings));
      step(changes, t, 1);
      t = step(stays, t, 1);
    }
    const std::vector<Vec3f> a = *changes.positions(), b = *stays.positions();
    for (std::size_t i = 0; i < a.size(); ++i) ASSERT_LT(length(a[i] - b[i]), 1e-5) << i;
  }
}

// Those that are carried rigidly are where they were, and as fast.
TEST_F(LiveSettings, CarriedStrandsAreAsFastInShorterSteps) {
  Hair hair = hairs()[2];
  ASSERT_TRUE(hair.kernel.features.roots);
  std::vector<Vec3f> tiny;
  for (int i = 0; i < 20; ++i) tiny.push_back(Vec3f(Vec3d{1, -1e-8 * i, 0}));
  hair.groom.addStrand(tiny);
  Simulation simulation = *born(device(), hair, hair.settings);
  ASSERT_EQ(Diagnostics(simulation).rigidStrandCount(), 1u);
  std::vector<HeadPose> poses;
  for (int k = 1; k <= hair.settings.stepsPerFrame; ++k)
    poses.push_back(headAt(k * hair.settings.stepSeconds()));
  ASSERT_TRUE(simulation.stepFrame(poses, {}, rootPosesOf(hair, 0, hair.settings)));
  const Vec3f before = simulation.state()->velocities.back();
  Settings shorter = hair.settings;
  shorter.framesPerSecond *= 2;
  ASSERT_TRUE(simulation.setSettings(shorter));
  const Vec3f after = simulation.state()->velocities.back();
  EXPECT_GT(length(before), 0.1f);
  EXPECT_LT(length(after - before), 0.05f * length(before));
}

TEST_F(LiveSettings, WhatMayNotChangeIsNamed) {
  const std::vector<std::pair<std::string, std::function<void(Settings&)>>> fixed{
      {"integrator", [](Settings& s) { s.integrator = Integrator::paper; }},
      {"preload", [](Settings& s) { s.gravityPreload = 0.5; }},
      {"roots", [](Settings& s) { s.rootCount = 2; }},
      {"contacts.radius", [](Settings& s) { s.contacts.radius = 0.01; }},
      {"contacts.on", [](Settings& s) { s.contacts.on = !s.contacts.on; }},
      {"air.on", [](Settings& s) { s.air.on = !s.air.on; }},
      {"air.turbulence", [](Settings& s) { s.air.turbulence = 1; }},
      {"9 steps of 1/216 s a frame", [](Settings& s) { s.stepsPerFrame = 9; }},
      {"8 steps of 1/96 s a frame", [](Settings& s) { s.framesPerSecond = 12; }},
      {"gravity.x", [](Settings& s) { s.gravity.x = NAN; }}};
  const Hair hair = hairs().front();
  Simulation simulation = *born(device(), hair, hair.settings),
             untouched = *born(device(), hair, hair.settings);
  for (const auto& [name, change] : fixed) {
    Settings wanted = hair.settings;
    change(wanted);
    wanted.gravity.y = 5;
    const Status status = simulation.setSettings(wanted);
    ASSERT_FALSE(status) << name;
    EXPECT_NE(status.error().message.find(name), std::string::npos) << status.error().message;
    EXPECT_EQ(simulation.settings().gravity, hair.settings.gravity);
  }
  step(simulation, 0, 2);
  step(untouched, 0, 2);
  EXPECT_TRUE(simulation.state()->positions == untouched.state()->positions);
}

}  // namespace
}  // namespace ringlet::test::live_settings_test
