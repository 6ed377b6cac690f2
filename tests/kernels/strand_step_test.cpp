// The strand kernel, all forms and integrators, against the float reference: every field of one step at
// awkward sizes, and positions after a frame against double. Mirrors shaders/kernels/strand_step.comp.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <numeric>

#include "ringlet/solver/diagnostics.h"
#include "tests/kernels/kernel_variants.h"
#include "tests/support/gpu_test.h"
#include "tests/support/parity.h"
#include "tests/support/tolerances.h"

namespace ringlet::test::strand_step_test {
namespace {

Settings settingsFor(Integrator integrator) {
  Settings settings;
  settings.integrator = integrator;
  settings.stepsPerFrame = integrator == Integrator::paper ? 30 : 8;
  settings.gravityPreload = integrator == Integrator::paper ? 0 : 0.7;
  return settings;
}

class StrandStep : public GpuTest {
 protected:
  void expectOneStep(const ParityCase& c, const std::string& label, double tolerance = kOneStep) {
    if (!makes(c.kernel, c.groom)) return;
    const auto errors = oneStepErrors(device(), c);
    fmt::print("{:<44} {}\n", label, toText(errors));
    for (const FieldError& e : errors)
      EXPECT_LE(e.error, tolerance) << label << ": " << e.field << "\n" << e.where;
  }
};

TEST_F(StrandStep, JacobiFieldsAgreeAtAwkwardSizes) {
  for (const Variant& variant : kVariants) {
    for (int strands : {1, 2, 31, 33, 127}) {
      expectOneStep(
          {randomGroom(awkwardLengths(strands), 7), {}, settingsFor(Integrator::jacobi), variant.kernel},
          fmt::format("jacobi, {}, {} strands", variant.name, strands));
    }
  }
}

TEST_F(StrandStep, UniformLengthsAgree) {
  for (int particles : {2, 3, 31, 100, 128}) {
    for (const Variant& variant : kVariants) {
      expectOneStep({randomGroom(std::vector<int>(33, particles), 11),
                     {},
                     settingsFor(Integrator::jacobi),
                     variant.kernel},
                    fmt::format("jacobi, {}, 33 x {}", variant.name, particles));
    }
  }
}

// Runs that are no power of two too; several shapes in one groom.
TEST_F(StrandStep, RunsOfEveryKindAgree) {
  for (int run : {5, 12, 14, 24}) {
    expectOneStep({randomGroom({2, run, 4 * run, 4 * run - 1, run + 1, 3 * run}, 29),
                   {},
                   settingsFor(Integrator::jacobi),
                   {.form = KernelChoice::Form::lanes, .particlesPerLane = run, .lanes = 4}},
                  fmt::format("jacobi, 4 lanes of {}", run));
  }
  for (int lanes : {1, 2}) {
    Settings settings = settingsFor(Integrator::jacobi);
    settings.rootCount = lanes;
    expectOneStep({randomGroom({2, 40, 3, 33, 40 * lanes, 40 * lanes - 1, 30 * lanes}, 41),
                   {},
                   settings,
                   {.form = KernelChoice::Form::lanes, .particlesPerLane = 40, .lanes = lanes}},
                  fmt::format("jacobi, {} long lanes", lanes));
  }
  expectOneStep({randomGroom({9, 40, 90, 9, 150, 90, 200}, 31),
                 {},
                 settingsFor(Integrator::jacobi),
                 {.manyKernels = true}},
                "jacobi, a shape a length");
}

TEST_F(StrandStep, PlainPointJacobiFieldsAgree) {
  for (const Variant& variant : kVariants) {
    Settings settings = settingsFor(Integrator::pointJacobi);
    settings.chebyshev = false;
    settings.pointIterations = 40;
    expectOneStep({randomGroom(awkwardLengths(33), 13), {}, settings, variant.kernel},
                  fmt::format("point_jacobi plain, {}", variant.name));
  }
}

// Enough iterations to converge: the k-th Chebyshev iterate changes k^2 times as much as the matrix does, so
// that one cut short shows the rounding of the coefficients, whoever computes it (6e-6 at 128 particles after
// 40).
TEST_F(StrandStep, ChebyshevPointJacobiFieldsAgree) {
  for (const Variant& variant : kVariants) {
    Settings settings = settingsFor(Integrator::pointJacobi);
    settings.pointIterations = 400;
    expectOneStep({randomGroom({2, 3, 5, 16, 17, 31, 33, 48, 64, 2, 31}, 13), {}, settings, variant.kernel},
                  fmt::format("point_jacobi chebyshev, {}", variant.name));
  }
}

TEST_F(StrandStep, PaperFieldsAgree) {
  for (const Variant& variant : kVariants) {
    expectOneStep({randomGroom(awkwardLengths(33), 17), {}, settingsFor(Integrator::paper), variant.kernel},
                  fmt::format("paper, {}", variant.name));
  }
}

TEST_F(StrandStep, VaryingMaterialsAgree) {
  Material material = varyingMaterial();
  material.gravityFactor = 0.8;
  Material bending;  // whose factors kernels find elsewhere
  bending.bendStiffnessProfile = material.bendStiffnessProfile;
  bending.lineDensityProfile = material.lineDensityProfile;
  for (Integrator integrator : {Integrator::jacobi, Integrator::pointJacobi, Integrator::paper}) {
    for (const Variant& variant : kVariants) {
      ParityCase c{randomGroom(awkwardLengths(25), 37), material, settingsFor(integrator), variant.kernel};
      c.settings.chebyshev = false;
      expectOneStep(c, fmt::format("varying material, {}, {}", int(integrator), variant.name));
      c.material = bending;
      expectOneStep(c, fmt::format("varying bending, {}, {}", int(integrator), variant.name));
    }
  }
}

TEST_F(StrandStep, MoreRootsAgree) {
  for (int roots : {2, 3}) {
    for (const Variant& variant : kVariants) {
      Settings settings = settingsFor(Integrator::jacobi);
      settings.rootCount = roots;
      expectOneStep({randomGroom(awkwardLengths(13), 19), {}, settings, variant.kernel},
                    fmt::format("jacobi, {} roots, {}", roots, variant.name));
    }
  }
}

// A head that is turned before it moves, with roots that leave their places while it spins.
TEST_F(StrandStep, ShiftedRootsOfATurnedHeadAgree) {
  for (Integrator integrator : {Integrator::jacobi, Integrator::pointJacobi, Integrator::paper}) {
    for (const Variant& variant : kVariants) {
      // Few lanes solve in a way of their own, in jacobi only.
      const bool isFew = variant.kernel.lanes == 1 || variant.kernel.lanes == 2;
      if (integrator != Integrator::jacobi && isFew) continue;
      ParityCase c{randomGroom(awkwardLengths(13), 43), {}, settingsFor(integrator), variant.kernel};
      c.settings.chebyshev = false;
      c.settings.rootCount = integrator == Integrator::jacobi ? 3 : 1;
      c.turned = fromRotationVector(Vec3d{1.2, -0.4, 0.8});
      c.shiftsRoots = true;
      expectOneStep(c, fmt::format("turned and shifted, {}, {}", int(integrator), variant.name));
    }
  }
}

TEST_F(StrandStep, LongStrandsAgreeInEveryIntegrator) {
  for (Integrator integrator : {Integrator::jacobi, Integrator::pointJacobi, Integrator::paper}) {
    Settings settings = settingsFor(integrator);
    settings.pointIterations = 150;
    settings.chebyshev = false;  // far from converged at this length, see above
    const int longest = integrator == Integrator::paper ? 700 : 1000;  // lavapipe's loops end at 704
    expectOneStep({randomGroom({longest, 129, 400, 40}, 23), {}, settings, {}},
                  fmt::format("integrator {}, up to {} particles", int(integrator), longest),
                  oneStepOf(static_cast<std::size_t>(longest)));
  }
}

// With Features::roots: every strand has poses of its own. Each form with one root, both with
// three.
TEST_F(StrandStep, RootsOfTheirOwnAgree) {
  for (Variant variant : kVariants) {
    variant.kernel.features.roots = true;
    const bool isDefault =
        variant.name == kVariants[0].name || variant.kernel.form == KernelChoice::Form::serial;
    for (Integrator integrator : {Integrator::jacobi, Integrator::paper}) {
      if (integrator == Integrator::paper && !isDefault) continue;
      Settings settings = settingsFor(integrator);
      settings.rootCount = isDefault && integrator == Integrator::jacobi ? 3 : 1;
      const auto lengths = isDefault ? awkwardLengths(33) : std::vector<int>{17, 31, 32, 20};
      expectOneStep({randomGroom(lengths, 43), {}, settings, variant.kernel},
                    fmt::format("moving roots, {}, {}", int(integrator), variant.name));
      if (!isDefault) continue;
      const ParityCase c{randomGroom(awkwardLengths(25), 47), {}, settings, variant.kernel};
      const FieldError e = oneFrameError(device(), c);
      fmt::print("one frame, moving roots, integrator {}, {:<12} {:.1e} of the arc length\n", int(integrator),
                 variant.name, e.error);
      EXPECT_LE(e.error, kOneFrame) << variant.name << ": " << e.where;
    }
  }
}

// Kernels of many heads have no taps: each form is tried by the frame.
TEST_F(StrandStep, AFrameOfOneOfManyHeadsAgreesWithDouble) {
  for (Variant variant : {kVariants[0], kVariants[7], kVariants[8]}) {
    variant.kernel.heads = 4;
    const ParityCase c{
        randomGroom(awkwardLengths(25), 29), {}, settingsFor(Integrator::jacobi), variant.kernel};
    const FieldError e = oneFrameError(device(), c);
    fmt::print("one frame, one of many heads, {:<12} {:.1e} of the arc length\n", variant.name, e.error);
    EXPECT_LE(e.error, kOneFrame) << variant.name << ": " << e.where;
  }
}

TEST_F(StrandStep, AFrameAgreesWithDouble) {
  for (Integrator integrator : {Integrator::jacobi, Integrator::pointJacobi, Integrator::paper}) {
    for (const Variant& variant : kVariants) {
      const ParityCase c{randomGroom(awkwardLengths(25), 29), {}, settingsFor(integrator), variant.kernel};
      const FieldError e = oneFrameError(device(), c);
      fmt::print("one frame, integrator {}, {:<12} {:.1e} of the arc length\n", int(integrator), variant.name,
                 e.error);
      EXPECT_LE(e.error, kOneFrame) << variant.name << ": " << e.where;
    }
  }
}

// Few long lanes pay only where they solve from the strand's ends; others would compile long kernels for
// nothing.
TEST_F(StrandStep, OnlyWhatIsSolvedFromItsEndsHasLongRuns) {
  const Groom groom = randomGroom(std::vector<int>(1000, 64), 3);
  const auto shapeOf = [&](Integrator integrator, const Material& material) {
    auto simulation = Simulation::create(device(), groom, material, settingsFor(integrator));
    EXPECT_TRUE(simulation) << simulation.error().message;
    return simulation ? Diagnostics(*simulation).kernels() : "";
  };
  if (shapeOf(Integrator::jacobi, {}).find("2 x 32") == std::string::npos)
    GTEST_SKIP() << "this device takes shorter runs";
  for (Integrator integrator : {Integrator::pointJacobi, Integrator::paper})
    EXPECT_NE(shapeOf(integrator, {}).find("4 x 16"), std::string::npos);
  EXPECT_NE(shapeOf(Integrator::jacobi, varyingMaterial()).find("4 x 16"), std::string::npos);
}

}  // namespace
}  // namespace ringlet::test::strand_step_test
