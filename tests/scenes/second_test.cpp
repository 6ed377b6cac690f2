// A whole second of shaking, device against the double reference, by measures: where the tips are and how far
// the longest edge went. Particle by particle, long runs may part; a second of this one does not.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "reference/step.h"
#include "ringlet/scene/motion.h"
#include "ringlet/solver/simulation.h"
#include "tests/support/gpu_test.h"
#include "tests/support/parity.h"
#include "tests/support/tolerances.h"

namespace ringlet::test::second_test {
namespace {

class WholeSecond : public GpuTest {
 protected:
  void expectSameSecond(const char* motionName, KernelChoice kernel) {
    const Groom groom = randomGroom({16, 31, 32, 64, 64, 64, 100, 128, 200}, 31);
    const Settings settings;
    const Motion motion = *motionByName(motionName, {0, 1, 0});
    auto simulation = Simulation::create(device(), groom, {}, settings, {}, kernel);
    ASSERT_TRUE(simulation) << simulation.error().message;
    reference::Simulation<double> expected(groom, {}, settings);
    for (int frame = 0; frame < 24; ++frame) {
      std::vector<HeadPose> poses;
      for (int k = 1; k <= 8; ++k) poses.push_back(motion.poseAt((frame * 8 + k) * settings.stepSeconds()));
      ASSERT_TRUE(simulation->stepFrame(poses));
      expected.stepFrame(poses);
    }
    const auto found = *simulation->positions();
    const auto report = *simulation->report();
    double tipError = 0, tipMove = 0;
    for (std::size_t s = 0; s < groom.strandCount(); ++s) {
      const std::size_t tip = groom.firstPoint[s + 1] - 1;
      const double arc = expected.restStrands()[s].arcLength;
      const Eigen::Vector3d rest = reference::toEigen<double>(groom.points[tip]);
      tipError = std::max(tipError,
                          (reference::toEigen<double>(found[tip]) - expected.positions()[tip]).norm() / arc);
      tipMove = std::max(tipMove, (expected.positions()[tip] - rest).norm() / arc);
    }
    fmt::print(
        "{}: after 1 s tips have moved up to {:.2f} of the arc length and differ by {:.1e}; stretch {:.6f} | "
        "{:.6f}\n",
        motionName, tipMove, tipError, report.maxEdgeStretch, expected.report().maxEdgeStretch);
    EXPECT_GT(tipMove, 0.05) << "nothing moved, so nothing was compared";
    EXPECT_LE(tipError, kOneSecond);
    EXPECT_NEAR(report.maxEdgeStretch, expected.report().maxEdgeStretch, 1e-4);
    EXPECT_EQ(report.nonfinite, 0u);
  }
};

TEST_F(WholeSecond, OfShakingAgrees) { expectSameSecond("shake", {}); }
TEST_F(WholeSecond, OfNoddingAgrees) { expectSameSecond("nod", {}); }
TEST_F(WholeSecond, OfSpinningAgrees) { expectSameSecond("spin", {}); }
TEST_F(WholeSecond, OfShakingAgreesInTheSerialForm) {
  expectSameSecond("shake", {KernelChoice::Form::serial});
}

// A strand whose numbers are lost is counted and named, and its stretch is not called fine.
TEST_F(WholeSecond, LostNumbersAreReported) {
  const Groom groom = randomGroom({16, 31, 200}, 8);
  for (std::size_t strand : {1u, 2u}) {
    auto simulation = Simulation::create(device(), groom, {}, {});
    ASSERT_TRUE(simulation);
    HairState state = *simulation->state();
    state.velocities[groom.firstPoint[strand] + 5].y = NAN;
    ASSERT_TRUE(simulation->setState(state));
    ASSERT_TRUE(simulation->stepFrame(HeadPose{}));
    const auto report = *simulation->report();
    EXPECT_GT(report.nonfinite, 0u);
    EXPECT_EQ(report.firstNonfiniteStrand, static_cast<std::int64_t>(strand));
    EXPECT_TRUE(std::isinf(report.maxEdgeStretch));
  }
}

}  // namespace
}  // namespace ringlet::test::second_test
