// Forces from outside (Simulation::setForces): device against reference in every form and integrator, and
// what they must come to.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/kernels/sample_hairs.h"
#include "tests/support/gpu_test.h"
#include "tests/support/tolerances.h"

namespace ringlet::test::forces_test {
namespace {

using Forces = GpuTest;

// Every kind of hair, built with forces from outside.
std::vector<Hair> pulledHairs() {
  std::vector<Hair> pulled = hairs();
  std::erase_if(pulled, [](const Hair& hair) { return hair.kernel.features.forces; });
  for (Hair& hair : pulled) hair.kernel.features.forces = true;
  return pulled;
}

std::vector<Vec3f> sameForce(const Hair& hair, Vec3f force) {
  return std::vector<Vec3f>(hair.groom.points.size(), force);
}

Simulation simulationOf(const ComputeDevice& device, Hair hair, bool withForces) {
  hair.kernel.features.forces = withForces;
  return *Simulation::create(*build(device, hair), {.bodies = hair.bodies});
}

HeadPose headAt(int frame) {
  return {Vec3d{0.01 * frame, 0, 0}, fromRotationVector(Vec3d{0, 0.05 * frame, 0})};
}

std::vector<KernelChoice> forms() {
  return {{},
          {.particlesPerLane = 17, .lanes = 1},
          {.particlesPerLane = 17, .lanes = 2},
          {.particlesPerLane = 16, .lanes = 4},
          {KernelChoice::Form::memory, 33, 4},
          {.form = KernelChoice::Form::serial}};
}

TEST_F(Forces, AgreeInEveryFormAndIntegrator) {
  for (const Integrator integrator : {Integrator::jacobi, Integrator::pointJacobi, Integrator::paper}) {
    for (KernelChoice kernel : forms()) {
      // Few lanes solve in a way of their own, in jacobi only.
      const bool isFew = kernel.lanes == 1 || kernel.lanes == 2;
      if (integrator != Integrator::jacobi && isFew) continue;
      kernel.features.forces = true;
      ParityCase c{randomGroom({2, 3, 31, 64, 100, 16, 17, 65}, 7), {}, {}, kernel};
      if (!makes(kernel, c.groom)) continue;
      c.settings.integrator = integrator;
      if (integrator == Integrator::paper) c.settings.stepsPerFrame = 30;
      c.settings.chebyshev = false;
      c.settings.pointIterations = 40;
      const std::string label = fmt::format("integrator {}, lanes {}", int(integrator), kernel.lanes);
      for (const FieldError& e : oneStepErrors(device(), c))
        EXPECT_LE(e.error, kOneStep) << label << ": " << e.field << "\n" << e.where;
      const FieldError e = oneFrameError(device(), c);
      EXPECT_LE(e.error, kOneFrame) << label << ": " << e.where;
    }
  }
}

// Among bodies, in air, with contacts, with roots that move.
TEST_F(Forces, AgreeAmongAllElse) {
  for (const Hair& hair : pulledHairs()) {
    const ParityCase c{hair.groom, {}, hair.settings, hair.kernel, 3, hair.bodies};
    if (hair.settings.contacts.on || hair.kernel.mostBufferBytes > 0) continue;  // taps need one chunk
    SCOPED_TRACE(hair.name);
    for (const FieldError& e : oneStepErrors(device(), c))
      EXPECT_LE(e.error, hair.bodies.empty() ? kOneStep : kOneStepAmongBodies) << e.field << "\n" << e.where;
  }
}

// The same on every particle: what another gravity does, bit for bit.
TEST_F(Forces, AreGravityWhereTheyAreTheSameEverywhere) {
  for (const Hair& hair : pulledHairs()) {
    SCOPED_TRACE(hair.name);
    Settings heavy = hair.settings;
    heavy.gravity = {1, -8, 0.5};  // sums are exact
    Settings light = hair.settings;
    light.gravity = {0, -6, 0};
    Simulation pulled = simulationOf(device(), hair, true), falls = simulationOf(device(), hair, false);
    ASSERT_TRUE(pulled.setSettings(light));
    ASSERT_TRUE(pulled.setForces(sameForce(hair, {1, -2, 0.5})));
    ASSERT_TRUE(falls.setSettings(heavy));
    for (int frame = 1; frame <= 3; ++frame) {
      ASSERT_TRUE(pulled.stepFrame(headAt(frame)));
      ASSERT_TRUE(falls.stepFrame(headAt(frame)));
    }
    EXPECT_TRUE(pulled.state()->positions == falls.state()->positions);
    EXPECT_TRUE(pulled.state()->velocities == falls.state()->velocities);
  }
}

// None, or none set: the bits of hair without.
TEST_F(Forces, OfZeroChangeNothing) {
  for (const Hair& hair : pulledHairs()) {
    SCOPED_TRACE(hair.name);
    Simulation without = simulationOf(device(), hair, false), unset = simulationOf(device(), hair, true),
               zero = simulationOf(device(), hair, true);
    ASSERT_TRUE(zero.setForces(sameForce(hair, {})));
    for (int frame = 1; frame <= 2; ++frame) {
      for (Simulation* each : {&without, &unset, &zero}) ASSERT_TRUE(each->stepFrame(headAt(frame)));
    }
    EXPECT_TRUE(unset.state()->positions == without.state()->positions);
    EXPECT_TRUE(zero.state()->positions == without.state()->positions);
  }
}

// On one strand's particles they move that strand and no other, however strands are ordered on the device.
TEST_F(Forces, ActWhereTheySay) {
  for (const Hair& hair : pulledHairs()) {
    if (hair.settings.contacts.on) continue;  // where one pushes the next
    SCOPED_TRACE(hair.name);
    Simulation still = simulationOf(device(), hair, true);
    ASSERT_TRUE(still.stepFrame(headAt(1)));
    const std::vector<Vec3f> expected = *still.positions();
    for (std::size_t s = 0; s < hair.groom.strandCount(); s += 2) {
      Simulation pulled = simulationOf(device(), hair, true);
      std::vector<Vec3f> forces = sameForce(hair, {});
      for (std::size_t i = hair.groom.firstPoint[s]; i < hair.groom.firstPoint[s + 1]; ++i)
        forces[i] = {0, 0, 40};
      ASSERT_TRUE(pulled.setForces(forces));
      ASSERT_TRUE(pulled.stepFrame(headAt(1)));
      const std::vector<Vec3f> found = *pulled.positions();
      for (std::size_t t = 0; t < hair.groom.strandCount(); ++t) {
        const auto begin = static_cast<std::ptrdiff_t>(hair.groom.firstPoint[t]),
                   end = static_cast<std::ptrdiff_t>(hair.groom.firstPoint[t + 1]);
        EXPECT_EQ(std::equal(found.begin() + begin, found.begin() + end, expected.begin() + begin), s != t)
            << "strand " << t << " when " << s << " is pulled";
      }
    }
  }
}

// Each frame has those set before it was submitted, however many are in flight; they stay until others are
// set.
TEST_F(Forces, AreTheFramesTheyWereSetFor) {
  for (const Hair& hair : pulledHairs()) {
    SCOPED_TRACE(hair.name);
    Simulation falls = simulationOf(device(), hair, false), flies = simulationOf(device(), hair, true);
    std::vector<std::vector<Vec3f>> expected, found;
    const auto posesOf = [&](int frame) {
      std::vector<HeadPose> poses;
      const int steps = hair.settings.stepsPerFrame;
      for (int k = 1; k <= steps; ++k)
        poses.push_back(interpolate(headAt(frame), headAt(frame + 1), double(k) / steps));
      return poses;
    };
    const auto forceOf = [](int frame) { return Vec3d{10.0 * (frame == 3 ? 2 : frame), 0, 5}; };
    for (int frame = 0; frame < 5; ++frame) {
      Settings heavy = hair.settings;  // as by another gravity in each frame
      heavy.gravity += forceOf(frame);
      ASSERT_TRUE(falls.setSettings(heavy));
      ASSERT_TRUE(falls.stepFrame(posesOf(frame)));
      expected.push_back(*falls.positions());
      if (frame != 3) {
        ASSERT_TRUE(flies.setForces(sameForce(hair, static_cast<Vec3f>(forceOf(frame)))));
      }
      ASSERT_TRUE(flies.submitFrame(posesOf(frame)));
      if (frame == 0) continue;
      ASSERT_TRUE(flies.waitFrame());
      found.push_back(flies.framePositions());
    }
    ASSERT_TRUE(flies.waitFrame());
    found.push_back(flies.framePositions());
    EXPECT_TRUE(found == expected);
  }
}

}  // namespace
}  // namespace ringlet::test::forces_test
