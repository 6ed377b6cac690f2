// The reported residual of the velocity solve, |r - L v| over |r| and a step's gravity: at float rounding for
// the strand block, and that of the reference's own iterate for point Jacobi. Mirrors
// shaders/integrators/residual.glsl.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "reference/kernels/strand_step.h"
#include "ringlet/solver/simulation.h"
#include "tests/support/gpu_test.h"
#include "tests/support/parity.h"
#include "tests/support/tolerances.h"

namespace ringlet::test::residual_test {
namespace {

// What the reference leaves of one strand's system after a step's solve, as the device reports it
// (shaders/equations/velocity_residual.glsl); the head stands still.
double residualOfReference(std::span<const Vec3f> points, const Settings& settings,
                           reference::Field<double> positions, reference::Field<double> velocities) {
  const double T = settings.stepSeconds();
  const auto rest = reference::makeRestStrand<double>(points, 1, Material{}, PaperMaterial{}, settings);
  const reference::Rotation<double> still = reference::Rotation<double>::Identity();
  reference::HeadStep<double> head{still, still, still, reference::Vector3<double>::Zero(), T};
  reference::StepScratch<double> scratch;
  reference::StrandTaps<double> taps;
  reference::StrandSystem system;
  reference::prepareStrand<double>(rest, settings, head, {}, {}, {}, {}, positions, velocities, scratch, taps,
                                   system);
  reference::solveVelocities<double>(rest, settings, head, {}, {}, system, scratch, taps, positions,
                                     velocities);
  double residualSquared = 0, scaleSquared = 0;
  for (std::size_t i = system.rootCount; i < system.particleCount(); ++i) {
    reference::Vector3<double> residual = system.momenta[i] - system.particleBlock(i) * velocities[i];
    residual += system.edgeBlock(i - 1) * velocities[i - 1];
    if (i + 1 < system.particleCount()) residual += system.edgeBlock(i) * velocities[i + 1];
    residualSquared += residual.squaredNorm();
    scaleSquared += system.momenta[i].squaredNorm() + std::pow(T * system.masses[i] * 9.81, 2);
  }
  return std::sqrt(residualSquared / scaleSquared);
}

class Residual : public GpuTest {
 protected:
  const Groom groom_ = randomGroom({3, 16, 24, 31}, 6);

  static Settings settingsOf(Integrator integrator, int iterations) {
    Settings settings;
    settings.integrator = integrator;
    settings.stepsPerFrame = 1;
    settings.framesPerSecond = 192;
    settings.pointIterations = iterations;
    return settings;
  }
  double residualOf(const Settings& settings, KernelChoice::Form form) {
    auto simulation =
        Simulation::create(device(), groom_, {}, settings, {}, {.form = form, .residual = true});
    EXPECT_TRUE(simulation) << simulation.error().message;
    EXPECT_TRUE(simulation->setState(randomState(groom_, settings, 3)));
    EXPECT_TRUE(simulation->stepFrame(HeadPose{}));
    return simulation->report()->velocityResidual;
  }
  // Of the worst strand.
  double expected(const Settings& settings) {
    const HairState start = randomState(groom_, settings, 3);
    double worst = 0;
    for (std::size_t s = 0; s < groom_.strandCount(); ++s) {
      reference::Field<double> positions, velocities;
      for (std::size_t i = groom_.firstPoint[s]; i < groom_.firstPoint[s + 1]; ++i) {
        positions.push_back(reference::toEigen<double>(start.positions[i]));
        velocities.push_back(reference::toEigen<double>(start.velocities[i]));
      }
      worst = std::max(worst, residualOfReference(groom_.strand(s), settings, positions, velocities));
    }
    return worst;
  }
};

TEST_F(Residual, IsRoundingForTheStrandBlockAndThatOfTheReferenceForPointIterations) {
  for (KernelChoice::Form form :
       {KernelChoice::Form::automatic, KernelChoice::Form::memory, KernelChoice::Form::serial}) {
    const double block = residualOf(settingsOf(Integrator::jacobi, 1), form);
    EXPECT_GT(block, 0) << "nothing was measured";
    EXPECT_LE(block, kSolveResidual);
    fmt::print("residual: strand block {:.1e}\n", block);
    for (const int iterations : {20, 600}) {
      const Settings settings = settingsOf(Integrator::pointJacobi, iterations);
      const double found = residualOf(settings, form), should = expected(settings);
      fmt::print("residual: {} point iterations {:.5f}, the reference's {:.5f}\n", iterations, found, should);
      EXPECT_NEAR(found, should, kSolveResidual) << iterations << " iterations";
      if (iterations == 20) {
        EXPECT_GT(should, 100 * kSolveResidual) << "20 iterations cannot have solved it";
      }
    }
  }
}

}  // namespace
}  // namespace ringlet::test::residual_test
