// The reported residual of the velocity solve, |r - L v| over |r| and a step's gravity: at float rounding for
// the strand block, and falling with the iterations for point Jacobi. Mirrors
// shaders/integrators/residual.glsl.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "ringlet/solver/simulation.h"
#include "tests/support/gpu_test.h"
#include "tests/support/parity.h"
#include "tests/support/tolerances.h"

namespace ringlet::test {
namespace {

class Residual : public GpuTest {
 protected:
  double residualOf(Integrator integrator, int iterations, KernelChoice::Form form) {
    const Groom groom = randomGroom({3, 16, 24, 31}, 6);
    Settings settings;
    settings.integrator = integrator;
    settings.pointIterations = iterations;
    auto simulation =
        Simulation::create(device(), groom, {}, settings, {}, {}, {.form = form, .residual = true});
    EXPECT_TRUE(simulation) << simulation.error().message;
    EXPECT_TRUE(simulation->setState(randomState(groom, settings, 3)));
    EXPECT_TRUE(simulation->stepFrame(HeadPose{}));
    return simulation->report()->velocityResidual;
  }
};

TEST_F(Residual, IsRoundingForTheStrandBlockAndFallsWithPointIterations) {
  for (KernelChoice::Form form : {KernelChoice::Form::automatic, KernelChoice::Form::serial}) {
    const double block = residualOf(Integrator::jacobi, 1, form);
    const double few = residualOf(Integrator::pointJacobi, 20, form),
                 many = residualOf(Integrator::pointJacobi, 600, form);
    fmt::print("residual: strand block {:.1e}; point Jacobi, 20 iterations {:.1e}, 600 {:.1e}\n", block, few,
               many);
    EXPECT_GT(block, 0) << "nothing was measured";
    EXPECT_LE(block, kSolveResidual);
    EXPECT_LE(many, kSolveResidual);
    EXPECT_GT(few, 100 * many) << "20 iterations cannot have solved it";
  }
}

}  // namespace
}  // namespace ringlet::test
