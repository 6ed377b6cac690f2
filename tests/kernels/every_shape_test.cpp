// Every shape (lanes x run) that the device offers, against the double reference: what `--lanes`, `--run`,
// KernelChoice and the plan can choose. Mirrors shaders/kernels/strand_step.comp and shaders/scan/.
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

#include "ringlet/solver/shape_plan.h"
#include "tests/support/gpu_test.h"
#include "tests/support/parity.h"
#include "tests/support/tolerances.h"

namespace ringlet::test {
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
    FieldError worst;
    std::string worstShape;
    int count = 0;
    for (int run = static_cast<int>(kShortestRun); run <= longest; ++run) {
      const auto runs = static_cast<std::uint32_t>(run);
      if (!isEveryShapeWanted() && !isRunOfInterest(runs, static_cast<std::uint32_t>(longest))) continue;
      ++count;
      const std::string shape = fmt::format("{} x {}", lanes, run);
      const ParityCase parityCase{
          randomGroom(lengthsAround(lanes, run), 53),
          material,
          {},
          {.form = KernelChoice::Form::lanes, .particlesPerLane = run, .lanes = lanes}};
      const FieldError error = oneFrameError(device(), parityCase);
      EXPECT_LE(error.error, kOneFrame) << shape << ": " << error.where;
      if (worstShape.empty() || !(error.error <= worst.error)) worst = error, worstShape = shape;
    }
    fmt::print("{} lanes, {} runs of {} to {}: at most {:.1e} of the arc length after a frame, in {}\n",
               lanes, count, kShortestRun, longest, worst.error, worstShape);
  }
};

TEST_P(EveryShape, OfHairAloneAgreesWithDouble) { expectAllRunsAgree(StrandWork::hairAlone, {}); }

// Bending that varies along the strand, and all that is no hair alone, is not solved from the strand's ends.
TEST_P(EveryShape, OfOtherHairAgreesWithDouble) { expectAllRunsAgree(StrandWork::plain, varyingMaterial()); }

INSTANTIATE_TEST_SUITE_P(Lanes, EveryShape, ::testing::Values(1, 2, 4, 8, 16, 32, 64, 128),
                         [](const auto& lanes) { return fmt::format("{}", lanes.param); });

}  // namespace
}  // namespace ringlet::test
