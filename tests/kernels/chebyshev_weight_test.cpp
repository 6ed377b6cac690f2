// Chebyshev's weights while they matter: few iterations, far from the solution, against the float reference.
// Mirrors shaders/equations/chebyshev_weight.glsl.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/support/gpu_test.h"
#include "tests/support/parity.h"
#include "tests/support/tolerances.h"

namespace ringlet::test::chebyshev_weight_test {
namespace {

class ChebyshevWeight : public GpuTest {};

TEST_F(ChebyshevWeight, IsThatOfTheReferenceAfterThirtyIterations) {
  for (const KernelChoice& kernel :
       {KernelChoice{KernelChoice::Form::automatic, 8}, KernelChoice{KernelChoice::Form::serial}}) {
    ParityCase c{randomGroom({17, 31, 32, 24}, 13), {}, {}, kernel};
    c.settings.integrator = Integrator::pointJacobi;
    c.settings.pointIterations = 30;
    const auto errors = oneStepErrors(device(), c);
    fmt::print("30 Chebyshev iterations: {}\n", toText(errors));
    for (const FieldError& e : errors)
      EXPECT_LE(e.error, kOneStepOfThirtyChebyshev) << e.field << "\n" << e.where;
  }
}

}  // namespace
}  // namespace ringlet::test::chebyshev_weight_test
