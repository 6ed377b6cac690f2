// Determinism: same input, device, driver and kernel variant give the same bits, however a run is cut into
// frames and dispatches, and with or without taps.
#include <gtest/gtest.h>

#include "ringlet/scene/motion.h"
#include "ringlet/solver/diagnostics.h"
#include "ringlet/solver/simulation.h"
#include "tests/support/gpu_test.h"
#include "tests/support/parity.h"

namespace ringlet::test::repeat_test {
namespace {

class Repeat : public GpuTest {
 protected:
  // `steps` outer steps of a shake at 1/192 s each, so many to a frame.
  HairState run(int steps, int stepsPerFrame, Integrator integrator, KernelChoice kernel = {}) {
    Settings settings;
    settings.framesPerSecond = 192.0 / stepsPerFrame;
    settings.stepsPerFrame = stepsPerFrame;
    settings.integrator = integrator;
    settings.pointIterations = 30;
    // In one lane lavapipe's loops end before 10 damping loops of 250 particles.
    if (kernel.form == KernelChoice::Form::serial) settings.dampingLoops = 4;
    const Motion motion = *motionByName("shake", {0, 1, 0});
    const Groom groom = randomGroom({2, 3, 31, 64, 64, 100, 128, 129, 250}, 9);
    auto simulation = Simulation::create(device(), groom, {}, settings, {}, kernel);
    EXPECT_TRUE(simulation) << simulation.error().message;
    for (int step = 0; step < steps; step += stepsPerFrame) {
      std::vector<HeadPose> poses;
      for (int k = 1; k <= stepsPerFrame; ++k) poses.push_back(motion.poseAt((step + k) / 192.0));
      EXPECT_TRUE(simulation->stepFrame(poses));
    }
    return *simulation->state();
  }

  void expectSameBits(const HairState& a, const HairState& b, const char* what) {
    EXPECT_TRUE(a.positions == b.positions) << what << ": positions differ";
    EXPECT_TRUE(a.velocities == b.velocities) << what << ": velocities differ";
  }
};

TEST_F(Repeat, TwoRunsGiveTheSameBits) {
  for (Integrator integrator : {Integrator::jacobi, Integrator::pointJacobi, Integrator::paper}) {
    expectSameBits(run(96, 8, integrator), run(96, 8, integrator), "two runs");
  }
}

// A frame of 330 steps must be cut into several dispatches on lavapipe, whose loops end after 65,535 turns; a
// dispatch that went past that would give other bits than single steps do.
TEST_F(Repeat, LongFramesGiveTheBitsOfSingleSteps) {
  for (KernelChoice::Form form :
       {KernelChoice::Form::automatic, KernelChoice::Form::memory, KernelChoice::Form::serial}) {
    expectSameBits(run(330, 330, Integrator::jacobi, {form}), run(330, 1, Integrator::jacobi, {form}),
                   "jacobi");
    expectSameBits(run(40, 40, Integrator::pointJacobi, {form}), run(40, 1, Integrator::pointJacobi, {form}),
                   "point_jacobi");
    expectSameBits(run(12, 12, Integrator::paper, {form}), run(12, 1, Integrator::paper, {form}), "paper");
  }
}

// Hair that wind presses onto a body, and that may not stretch: then a step has the most turns of loops.
TEST_F(Repeat, LongFramesAmongBodiesGiveTheBitsOfSingleSteps) {
  constexpr int kSteps = 16;
  Groom groom;
  groom.metresPerUnit = 1;
  for (int s = 0; s < 3; ++s) {
    std::vector<Vec3f> strand;
    for (int i = 0; i < 250; ++i) strand.push_back(Vec3f(Vec3d{0.001 * i, 0, 0.01 * s}));
    groom.addStrand(strand);
  }
  Settings settings;
  settings.maxStretch = 1;
  settings.air = {.on = true, .fallSpeed = 2, .wind = {0, -20, 1}, .turbulence = 2};
  const std::vector<Body> bodies{{.name = "ball", .radius = 0.05, .place = {{0.12, -0.051, 0}, {}}}};
  const auto run = [&](int stepsPerFrame, KernelChoice::Form form) {
    settings.stepsPerFrame = stepsPerFrame;
    settings.framesPerSecond = 192.0 / stepsPerFrame;
    auto simulation = Simulation::create(device(), groom, {}, settings, {.bodies = bodies}, {form});
    EXPECT_TRUE(simulation) << simulation.error().message;
    for (int step = 0; step < kSteps; step += stepsPerFrame) EXPECT_TRUE(simulation->stepFrame(HeadPose{}));
    return *simulation->state();
  };
  for (const KernelChoice::Form form : {KernelChoice::Form::memory, KernelChoice::Form::serial})
    expectSameBits(run(kSteps, form), run(1, form), "a body and air");
}

// One text, of which lavapipe, that joins no multiplications and additions, makes the same operations. Not so
// of point_jacobi, whose loop it simplifies in registers, and on other drivers.
TEST_F(Repeat, RunsInMemoryHaveTheBitsOfRegisters) {
  if (device().name().find("llvmpipe") == std::string::npos) GTEST_SKIP() << "another driver";
  using Form = KernelChoice::Form;
  for (const Integrator integrator : {Integrator::jacobi, Integrator::paper}) {
    expectSameBits(run(16, 8, integrator, {Form::lanes, 32, 8}),
                   run(16, 8, integrator, {Form::memory, 32, 8}), "in memory");
  }
}

TEST_F(Repeat, TapsChangeNoBit) {
  for (KernelChoice kernel :
       {KernelChoice{}, KernelChoice{KernelChoice::Form::automatic, 8},
        KernelChoice{KernelChoice::Form::memory}, KernelChoice{KernelChoice::Form::serial}}) {
    for (Integrator integrator : {Integrator::jacobi, Integrator::pointJacobi, Integrator::paper}) {
      KernelChoice withTaps = kernel;
      withTaps.taps = true;
      expectSameBits(run(24, 8, integrator, kernel), run(24, 8, integrator, withTaps), "taps");
    }
  }
}

TEST_F(Repeat, MeasuringTheResidualChangesNoBit) {
  for (KernelChoice::Form form :
       {KernelChoice::Form::automatic, KernelChoice::Form::memory, KernelChoice::Form::serial}) {
    for (Integrator integrator : {Integrator::jacobi, Integrator::pointJacobi}) {
      expectSameBits(run(24, 8, integrator, {form}), run(24, 8, integrator, {.form = form, .residual = true}),
                     "residual");
    }
  }
}

TEST_F(Repeat, StateCanBePutBack) {
  Settings settings;
  const Groom groom = randomGroom({31, 64, 300}, 4);
  auto simulation = Simulation::create(device(), groom, {}, settings);
  ASSERT_TRUE(simulation);
  ASSERT_TRUE(simulation->setState(randomState(groom, settings, 2)));
  const HairState start = *simulation->state();
  ASSERT_TRUE(simulation->stepFrame(HeadPose{}));
  const HairState first = *simulation->state();
  ASSERT_TRUE(simulation->setState(start));
  ASSERT_TRUE(simulation->stepFrame(HeadPose{}));
  expectSameBits(first, *simulation->state(), "the same state stepped again");
}

// The first step outgrows the lists, which begin short, and is done again in longer ones; once the state is
// put back there is room at once. Both are a first step, which has nothing to remember.
TEST_F(Repeat, StateWithContactsCanBePutBackAndRoomMadeInBetween) {
  Groom groom;
  groom.metresPerUnit = 1;
  for (int s = 0; s < 100; ++s) {
    const Vec3f root(Vec3d{0.01 * (s % 10), 0, 0.01 * (s / 10)});
    groom.addStrand(std::vector<Vec3f>{root, root + Vec3f{0, -0.005f, 0}, root + Vec3f{0, -0.01f, 0}});
  }
  Settings settings;
  settings.stepsPerFrame = 1;
  settings.contacts.on = true;
  settings.contacts.method = ContactMethod::explicitPairs;
  settings.contacts.radius = 0.002;
  settings.contacts.prunePairs = false;
  auto simulation = Simulation::create(device(), groom, {}, settings);
  ASSERT_TRUE(simulation) << simulation.error().message;
  HairState start = randomState(groom, settings, 3);
  for (std::size_t i = 0; i < start.positions.size(); ++i) {
    if (i % 3 != 0) start.positions[i] = start.positions[i] * 0.1f;  // all but roots, near one place
  }
  const auto bytes = Diagnostics(*simulation).memory().contactLists;
  ASSERT_TRUE(simulation->setState(start));
  ASSERT_TRUE(simulation->stepFrame(HeadPose{}));
  const HairState first = *simulation->state();
  EXPECT_GT(Diagnostics(*simulation).memory().contactLists, bytes) << "lists had room from the start";
  EXPECT_GT(simulation->contactReport()->contacts, 100u);
  EXPECT_EQ(simulation->contactReport()->rebuilds, 1u);
  ASSERT_TRUE(simulation->stepFrame(HeadPose{}));
  const std::uint64_t rebuilds = simulation->contactReport()->rebuilds;
  ASSERT_TRUE(simulation->setState(start));
  ASSERT_TRUE(simulation->stepFrame(HeadPose{}));
  expectSameBits(first, *simulation->state(), "the same state stepped again");
  EXPECT_EQ(simulation->contactReport()->rebuilds, rebuilds + 1);
}

}  // namespace
}  // namespace ringlet::test::repeat_test
