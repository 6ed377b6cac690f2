// Every shape (lanes x run, in registers and in memory) that the device offers, against the double reference:
// what `--lanes`, `--run`, KernelChoice and the plan can choose. Mirrors shaders/kernels/strand_step.comp and
// shaders/scan/.
//
// A driver compiles each run anew, and lavapipe takes a quarter of an hour for all of them. So only with
// RINGLET_EVERY_SHAPE=1 all are tested; without, those at which the code changes its course: the binary
// length of the run decides how often filter_scan.glsl squares, and its other digits where it multiplies.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <string_view>

#include "ringlet/solver/plan/shape_plan.h"
#include "tests/support/gpu_test.h"
#include "tests/support/parity.h"
#include "tests/support/tolerances.h"

namespace ringlet::test::every_shape_test {
namespace {

// Strands that fill the shape, all but a particle, all lanes but one and a particle; and the shortest there
// are.
std::vector<int> lengthsAround(int lanes, int run) {
  std::vector<int> lengths{2, lanes * run, lanes * run - 1, run + 1};
  if (lanes > 1) lengths.push_back((lanes - 1) * run + 1);
  for (int& length : lengths) length = std::min(length, lanes * run);
  return lengths;
}

bool isEveryShapeWanted() {
  const char* value = std::getenv("RINGLET_EVERY_SHAPE");
  return value && std::string_view(value) == "1";
}

// In memory a run is a number to the code: of short and long ones, beside 64, some.
std::vector<int> runsInMemory() {
  if (isEveryShapeWanted()) return {4, 5, 7, 8, 16, 31, 32, 33, 63, 64, 65, 96, 128, 200};
  return {5, 32, 70};
}

// The powers of two, the runs one shorter, and the longest run.
bool isRunOfInterest(std::uint32_t run, std::uint32_t longest) {
  return std::has_single_bit(run) || std::has_single_bit(run + 1) || run == longest;
}

class EveryShape : public GpuTest, public ::testing::WithParamInterface<int> {
 protected:
  void expectAllRunsAgree(StrandWork work, const Material& material) {
    const DeviceLimits limits = device().limits();
    const int lanes = GetParam();
    if (!limits.hasSubgroupShuffle || static_cast<int>(limits.subgroupSize) < lanes)
      GTEST_SKIP() << "this device has subgroups of " << limits.subgroupSize << " invocations";
    const int longest = static_cast<int>(longestRun(limits, static_cast<std::uint32_t>(lanes), work));
    std::vector<int> runs;
    for (int run = static_cast<int>(kShortestRun); run <= longest; ++run) {
      const auto one = static_cast<std::uint32_t>(run);
      if (isEveryShapeWanted() || isRunOfInterest(one, static_cast<std::uint32_t>(longest)))
        runs.push_back(run);
    }
    expectRunsAgree(KernelChoice::Form::lanes, runs, material);
    expectRunsAgree(KernelChoice::Form::memory, runsInMemory(), material);
  }

 private:
  void expectRunsAgree(KernelChoice::Form form, const std::vector<int>& runs, const Material& material) {
    const int lanes = GetParam();
    FieldError worst;
    std::string worstShape;
    for (const int run : runs) {
      const std::string shape = fmt::format("{} x {}", lanes, run);
      const ParityCase parityCase{randomGroom(lengthsAround(lanes, run), 53),
                                  material,
                                  {},
                                  {.form = form, .particlesPerLane = run, .lanes = lanes}};
      const FieldError error = oneFrameError(device(), parityCase);
      EXPECT_LE(error.error, kOneFrame) << shape << ": " << error.where;
      if (worstShape.empty() || !(error.error <= worst.error)) worst = error, worstShape = shape;
    }
    fmt::print("{} lanes, {} runs of {} to {} in {}: at most {:.1e} of the arc length after a frame, in {}\n",
               lanes, runs.size(), runs.front(), runs.back(),
               form == KernelChoice::Form::memory ? "memory" : "registers", worst.error, worstShape);
  }
};

TEST_P(EveryShape, OfHairAloneAgreesWithDouble) { expectAllRunsAgree(StrandWork::hairAlone, {}); }

// Bending that varies along the strand, and all that is no hair alone, is not solved from the strand's ends.
TEST_P(EveryShape, OfOtherHairAgreesWithDouble) { expectAllRunsAgree(StrandWork::plain, varyingMaterial()); }

INSTANTIATE_TEST_SUITE_P(Lanes, EveryShape, ::testing::Values(1, 2, 4, 8, 16, 32, 64, 128),
                         [](const auto& lanes) { return fmt::format("{}", lanes.param); });

}  // namespace
}  // namespace ringlet::test::every_shape_test
