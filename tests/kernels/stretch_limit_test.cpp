// The stretch limit in the strand kernels: one step of hair most of whose edges are too long, against the
// float reference, in every kernel form and among bodies. Mirrors shaders/equations/stretch_limit.glsl and
// shaders/scan/prefix_sum.glsl.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/support/gpu_test.h"
#include "tests/support/parity.h"
#include "tests/support/sample_bodies.h"
#include "tests/support/tolerances.h"

namespace ringlet::test::stretch_limit_test {
namespace {

class StretchLimit : public GpuTest {
 protected:
  // The noise of randomState lengthens about half of the edges by up to a hundredth.
  void expectLimited(Integrator integrator, const KernelChoice& kernel, const std::vector<int>& lengths,
                     const std::string& label) {
    ParityCase c{randomGroom(lengths, 51), {}, {}, kernel, 8};
    c.settings.integrator = integrator;
    c.settings.stepsPerFrame = integrator == Integrator::paper ? 30 : 8;
    c.settings.maxStretch = 1.001;
    c.settings.gravityPreload = integrator == Integrator::paper ? 0 : 1;
    SimulationReport report;
    const auto errors = oneStepErrors(device(), c, &report);
    fmt::print("{:<24} {:.2f} of the edges limited; {}\n", label, report.limitedShare, toText(errors));
    EXPECT_GT(report.limitedShare, 0.2) << label << ": the limit was hardly reached, and nothing is tested";
    for (const FieldError& e : errors)
      EXPECT_LE(e.error, kOneStep) << label << ": " << e.field << "\n" << e.where;
  }
};

TEST_F(StretchLimit, AStepAgreesInEveryForm) {
  const auto& limits = device().limits();
  for (const int lanes : {1, 2, 4, 8}) {
    if (lanes > 1 && (!limits.hasSubgroupShuffle || static_cast<int>(limits.subgroupSize) < lanes)) {
      fmt::print("SKIPPED: {} lanes, this device has subgroups of {} invocations\n", lanes,
                 limits.subgroupSize);
      continue;
    }
    const KernelChoice kernel{.form = KernelChoice::Form::lanes, .particlesPerLane = 8, .lanes = lanes};
    expectLimited(Integrator::jacobi, kernel, {8 * lanes, 7 * lanes + 1, 8 * lanes - 1},
                  fmt::format("{} lanes of 8", lanes));
  }
  expectLimited(Integrator::jacobi, {.form = KernelChoice::Form::serial}, {2, 31, 64}, "serial");
}

// Which limits rates as well.
TEST_F(StretchLimit, AStepOfThePaperAgrees) {
  const KernelChoice lanes{.form = KernelChoice::Form::lanes, .particlesPerLane = 8, .lanes = 4};
  expectLimited(Integrator::paper, lanes, {32, 29, 31}, "paper, 4 lanes of 8");
  expectLimited(Integrator::paper, {.form = KernelChoice::Form::serial}, {2, 31, 64}, "paper, serial");
}

// What the limit moves may be moved into a body, also where nothing of the strand touched one on its way.
TEST_F(StretchLimit, AStepAmongBodiesAgrees) {
  ParityCase c{randomGroom(std::vector<int>(200, 32), 53), {}, {}, {}, 8};
  for (int k = 0; k < 64; ++k) {
    const Vec3d place{0.06 * (k % 4) - 0.09, -0.1 - 0.05 * (k / 4 % 4), 0.06 * (k / 16) - 0.09};
    c.bodies.push_back({.radius = 0.006, .place = {place, {}}});
  }
  c.settings.stepsPerFrame = 1;
  c.settings.maxStretch = 1.001;
  c.material.stretchStiffness = 0.1;  // so that the limit shortens much
  SimulationReport report;
  const auto errors = oneStepErrors(device(), c, &report);
  fmt::print("among bodies {:.2f} of the edges limited; {}\n", report.limitedShare, toText(errors));
  EXPECT_GT(report.limitedShare, 0.2);
  for (const FieldError& e : errors) EXPECT_LE(e.error, kOneStepAmongBodies) << e.field << "\n" << e.where;
}

}  // namespace
}  // namespace ringlet::test::stretch_limit_test
