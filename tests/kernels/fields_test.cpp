// Fields (Simulation::setFields): device against reference in every form, and what they must come to.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "parity/contacts.h"
#include "tests/kernels/sample_hairs.h"
#include "tests/support/gpu_test.h"
#include "tests/support/tolerances.h"

namespace ringlet::test::fields_test {
namespace {

using Fields = GpuTest;
using parity::sampleFields;

Simulation simulationOf(const ComputeDevice& device, Hair hair, bool withFields) {
  hair.kernel.features.fields = withFields;
  return *Simulation::create(*build(device, hair), {.bodies = hair.bodies});
}

HeadPose headAt(int frame) {
  return {Vec3d{0.01 * frame, 0, 0}, fromRotationVector(Vec3d{0, 0.05 * frame, 0})};
}

TEST_F(Fields, AgreeInEveryForm) {
  for (KernelChoice kernel : {KernelChoice{},
                              {.particlesPerLane = 17, .lanes = 1},
                              {.particlesPerLane = 17, .lanes = 2},
                              {.particlesPerLane = 16, .lanes = 4},
                              {KernelChoice::Form::memory, 33, 4},
                              {.form = KernelChoice::Form::serial}}) {
    kernel.features.fields = true;
    kernel.features.goals = kernel.lanes != 1;  // with and without
    const ParityCase c{randomGroom({2, 3, 31, 64, 100, 16, 17, 65}, 7), {}, {}, kernel};
    SCOPED_TRACE(fmt::format("lanes {}", kernel.lanes));
    for (const FieldError& e : oneStepErrors(device(), c))
      EXPECT_LE(e.error, kOneStep) << e.field << "\n" << e.where;
    const FieldError e = oneFrameError(device(), c, 2);
    EXPECT_LE(e.error, kOneFrame) << e.where;
  }
}

// Among bodies, in air, with forces, with roots that move; records from storage.
TEST_F(Fields, AgreeAmongAllElse) {
  for (Hair hair : hairs()) {
    hair.kernel.features.fields = true;
    const ParityCase c{hair.groom, varyingMaterial(), hair.settings, hair.kernel, 3, hair.bodies};
    if (hair.settings.contacts.on || hair.kernel.mostBufferBytes > 0) continue;  // taps need one chunk
    SCOPED_TRACE(hair.name);
    for (const FieldError& e : oneStepErrors(device(), c))
      EXPECT_LE(e.error, hair.bodies.empty() ? kOneStep : kOneStepAmongBodies) << e.field << "\n" << e.where;
  }
}

TEST_F(Fields, AgreeWithContacts) {
  for (const ContactMethod method : {ContactMethod::explicitPairs, ContactMethod::volume}) {
    Settings settings = parity::meetingSettings();
    settings.contacts.method = method;
    const Groom groom = parity::denseSwatch(32);
    const auto unheeded = [](const Simulation&, const auto&) {};
    const auto error =
        parity::shakenError(device(), groom, settings, {.features = {.fields = true}}, 2, unheeded);
    ASSERT_TRUE(error) << error.error().message;
    EXPECT_LT(*error, parity::kMeetingMetres) << int(method);
  }
}

// Every field by itself moves hair, so that none is lost among others.
TEST_F(Fields, EachActs) {
  const Hair hair = hairs()[0];
  Simulation without = simulationOf(device(), hair, true);
  ASSERT_TRUE(without.stepFrame(HeadPose{}));
  for (const ForceField& field : sampleFields({}, 0)) {
    if (field.name == "brake") continue;  // hair is at rest
    Simulation within = simulationOf(device(), hair, true);
    ASSERT_TRUE(within.setFields(std::span(&field, 1)));
    ASSERT_TRUE(within.stepFrame(HeadPose{}));
    EXPECT_FALSE(within.state()->velocities == without.state()->velocities) << field.name;
  }
}

// None, or of no strength: the bits of hair without.
TEST_F(Fields, OfNoStrengthChangeNothing) {
  std::vector<ForceField> nothing = sampleFields({}, 0);
  for (ForceField& field : nothing) {
    field.axial = field.radial = field.around = field.drag = 0;
    field.gridShare = 0;
  }
  for (const Hair& hair : hairs()) {
    SCOPED_TRACE(hair.name);
    Simulation without = simulationOf(device(), hair, false), unset = simulationOf(device(), hair, true),
               zero = simulationOf(device(), hair, true);
    ASSERT_TRUE(zero.setFields(nothing));
    for (int frame = 1; frame <= 2; ++frame) {
      for (Simulation* each : {&without, &unset, &zero}) ASSERT_TRUE(each->stepFrame(headAt(frame)));
    }
    EXPECT_TRUE(unset.state()->positions == without.state()->positions);
    EXPECT_TRUE(zero.state()->positions == without.state()->positions);
  }
}

// Other fields while hair moves, another number of them, other grids, none: from the next frame on as if they
// had been there from the beginning.
TEST_F(Fields, AreReplacedWhileHairMoves) {
  const Hair hair = hairs()[0];
  const std::vector<ForceField> all = sampleFields({}, 0);
  Simulation live = simulationOf(device(), hair, true);
  for (int frame = 1; frame <= 2; ++frame) ASSERT_TRUE(live.stepFrame(headAt(frame)));
  for (const std::size_t count : {std::size_t(2), all.size(), std::size_t(0), std::size_t(5)}) {
    Simulation built = simulationOf(device(), hair, true);
    ASSERT_TRUE(built.setFields(std::span(all).first(count)));
    // The head's history, then the state.
    for (int frame = 1; frame <= 2; ++frame) ASSERT_TRUE(built.stepFrame(headAt(frame)));
    Simulation changed = simulationOf(device(), hair, true);
    for (int frame = 1; frame <= 2; ++frame) ASSERT_TRUE(changed.stepFrame(headAt(frame)));
    ASSERT_TRUE(built.setState(*live.state()));
    ASSERT_TRUE(changed.setState(*live.state()));
    ASSERT_TRUE(changed.setFields(std::span(all).first(count)));
    for (Simulation* each : {&built, &changed}) ASSERT_TRUE(each->stepFrame(headAt(3)));
    EXPECT_TRUE(built.state()->positions == changed.state()->positions) << count;
  }
}

// Where a field goes in a frame is where it stays: as if it were set anew before each later frame.
TEST_F(Fields, AreHeldUntilOthersAreSet) {
  const Hair hair = hairs()[0];
  const std::vector<ForceField> before = sampleFields({}, 0), after = sampleFields({}, 0.1);
  Simulation once = simulationOf(device(), hair, true), anew = simulationOf(device(), hair, true);
  for (int frame = 1; frame <= 7; ++frame) {
    if (frame == 1) {
      for (Simulation* each : {&once, &anew}) ASSERT_TRUE(each->setFields(before));
    }
    if (frame == 4) {
      for (Simulation* each : {&once, &anew}) ASSERT_TRUE(each->setFields(after, before));
    }
    if (frame > 4) {
      ASSERT_TRUE(anew.setFields(after));
    }
    for (Simulation* each : {&once, &anew}) ASSERT_TRUE(each->stepFrame(headAt(frame)));
    EXPECT_TRUE(once.state()->positions == anew.state()->positions) << "frame " << frame;
  }
}

// As many as before, but a grid is another one.
TEST_F(Fields, TakeOtherGrids) {
  const Hair hair = hairs()[0];
  ForceField field = sampleFields({}, 0).back();
  ForceField other = field;
  VelocityGrid turned = *field.grid;
  std::ranges::reverse(turned.velocities);
  other.grid = std::make_shared<const VelocityGrid>(turned);
  Simulation changed = simulationOf(device(), hair, true), built = simulationOf(device(), hair, true);
  ASSERT_TRUE(changed.setFields(std::span(&field, 1)));
  for (Simulation* each : {&changed, &built}) {
    ASSERT_TRUE(each->setFields(std::span(&other, 1)));
    ASSERT_TRUE(each->stepFrame(headAt(1)));
  }
  EXPECT_TRUE(built.state()->positions == changed.state()->positions);
}

// Hair that sleeps wakes for a field that comes.
TEST_F(Fields, WakeHair) {
  Hair hair = hairs()[0];
  hair.settings.sleepSpeed = 0.01;
  Simulation asleep = simulationOf(device(), hair, true);
  for (int frame = 0; frame < 12; ++frame) ASSERT_TRUE(asleep.stepFrame(HeadPose{}));
  const std::vector<Vec3f> before = *asleep.positions();
  const ForceField along{.axis = {1, 0, 0}, .axial = 20};
  ASSERT_TRUE(asleep.setFields(std::span(&along, 1)));
  for (int frame = 0; frame < 4; ++frame) ASSERT_TRUE(asleep.stepFrame(HeadPose{}));
  EXPECT_FALSE(before == *asleep.positions());
}

TEST_F(Fields, AreRefused) {
  const Hair hair = hairs()[0];
  const std::vector<ForceField> all = sampleFields({}, 0);
  Simulation simulation = simulationOf(device(), hair, true);
  const ForceField wrong{.name = "storm", .drag = -1};
  const Status outside = simulation.setFields(std::span(&wrong, 1));
  ASSERT_FALSE(outside);
  EXPECT_NE(outside.error().message.find("storm"), std::string::npos);
  const std::vector<ForceField> many(kMostForceFields + 1);
  EXPECT_FALSE(simulation.setFields(many));

  Hair baseline = hair;
  baseline.settings.integrator = Integrator::paper;
  baseline.kernel.features.fields = true;
  EXPECT_FALSE(build(device(), baseline));
}

}  // namespace
}  // namespace ringlet::test::fields_test
