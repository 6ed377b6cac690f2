// The hand-vectorised loop against the double reference: as near as the kernel must be. A baseline that
// computed something else would measure nothing.
#include "bench/hand_vectorised.h"

#include <gtest/gtest.h>

#include "bench/curls.h"
#include "reference/step.h"

namespace ringlet::bench {
namespace {

// The largest distance after two shaken frames, share of a strand's length.
double disagreement(const Groom& groom, const Material& material, const Settings& settings) {
  auto hand = HandVectorised::create(groom, material, settings, 2);
  EXPECT_TRUE(hand) << hand.error().message;
  if (!hand) return INFINITY;
  reference::Simulation<double> expected(groom, material, settings);
  for (int frame = 0; frame < 2; ++frame) {
    const auto poses = shaken(settings, frame * settings.stepsPerFrame);
    hand->stepFrame(poses);
    expected.stepFrame(poses);
  }
  EXPECT_NEAR(hand->maxStretch(), expected.report().maxEdgeStretch, 1e-5);
  const auto found = hand->positions();
  double largest = 0;
  for (std::size_t i = 0; i < found.size(); ++i)
    largest = std::max(largest, (reference::toEigen<double>(found[i]) - expected.positions()[i]).norm());
  return largest / kCurlLength;
}

TEST(HandVectorised, AgreesWithTheReference) {
  if (!canSweep()) GTEST_SKIP() << "no AVX2 and FMA here";
  Settings settings;
  Material twoSmoothings;
  twoSmoothings.coreSmoothingLength = 0.02;
  for (const int rootCount : {1, 3}) {
    settings.rootCount = rootCount;
    settings.maxStretch = rootCount == 1 ? 1.1 : 1.003;  // never met; met by many edges
    for (const Material& material : {Material{}, twoSmoothings}) {
      for (const int particles : {4, 64, 256})
        EXPECT_LT(disagreement(curls(9, particles), material, settings), 1e-5)
            << particles << ", " << rootCount;
      const std::vector<int> mixed{4, 64, 17, 16, 100, 33, 5, 48, 128, 31, 65};
      EXPECT_LT(disagreement(curls(mixed), material, settings), 1e-5) << "mixed, " << rootCount;
    }
  }
}

// A step of an edge is a few hundred operations, and nothing but: another strand, another step, cost what the
// first did.
TEST(HandVectorised, CountsOperations) {
  if (!canSweep()) GTEST_SKIP() << "no AVX2 and FMA here";
  const auto count = [](int strands, int particles, std::uint32_t steps) {
    return HandVectorised::create(curls(strands, particles), {}, {}, 1)->operations(steps);
  };
  const std::uint64_t once = count(1, 64, 1), twice = count(1, 64, 2), perStep = twice - once;
  EXPECT_EQ(count(1, 64, 9) - twice, 7 * perStep);
  EXPECT_EQ(count(11, 64, 2), 11 * twice);
  EXPECT_GT(perStep, 63 * 200);
  EXPECT_LT(perStep, 63 * 600);
  RecordProperty("per_edge_step", static_cast<int>(perStep / 63));
}

TEST(HandVectorised, SaysWhatItLeavesOut) {
  if (!canSweep()) GTEST_SKIP() << "no AVX2 and FMA here";
  Settings air;
  air.air.on = true;
  EXPECT_FALSE(HandVectorised::create(curls(1, 8), {}, air, 1));
  Material varies;
  varies.bendStiffnessProfile.points = {{0, 1}, {1, 0.5}};
  EXPECT_FALSE(HandVectorised::create(curls(1, 8), varies, {}, 1));
}

}  // namespace
}  // namespace ringlet::bench
