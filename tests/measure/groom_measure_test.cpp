// measure/groom_measure.h: summaries over strands, errors that name the strand, and real coils.
#include "ringlet/measure/groom_measure.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <limits>

#include "ringlet/groom/groom_file.h"
#include "ringlet/measure/motion_measure.h"
#include "tests/measure/strand_samples.h"
#include "tests/support/test_support.h"

namespace ringlet::groom_measure_test {
namespace {

using namespace test;

TEST(Spread, OfValues) {
  const std::vector<double> values{3, -5, 4};
  const Spread spread = spreadOf(values);
  EXPECT_NEAR(spread.mean, 2.0 / 3, 1e-15);
  EXPECT_EQ(spread.min, -5);
  EXPECT_EQ(spread.max, 4);
  EXPECT_EQ(worstOf(spread), -5);
  EXPECT_EQ(spreadOf({}).max, 0);
}

TEST(GroomMeasure, SummarizesMixedStrands) {
  Groom rest = groomOf({cut({}, 64), cut({.turns = 4, .handedness = -1}, 40), cut({.radius = 0}, 10)});
  rest.metresPerUnit = 0.01;
  for (Vec3f& p : rest.points) p = p * 100.0f;
  auto ruler = GroomRuler::make(rest);
  ASSERT_TRUE(ruler) << ruler.error().message;
  const GroomMeasure groom = ruler->summarize(ruler->rest());
  EXPECT_EQ(groom.strandCount, 3u);
  EXPECT_EQ(groom.particleCount, 114u);
  EXPECT_EQ(groom.curledCount, 2u);
  EXPECT_EQ(groom.rightHandedCount, 1u);
  EXPECT_EQ(groom.leftHandedCount, 1u);
  EXPECT_NEAR(groom.turns.max, 8, 0.01);
  EXPECT_NEAR(groom.coreLength.mean, 0.25, 1e-4);

  // Another unit, another place; the straight strand does not dilute the curls.
  std::vector<Vec3f> points = rest.points;
  for (Vec3f& p : points) p = (p + Vec3f{1, 2, 3}) * 0.01f;
  auto measures = ruler->measure(points, 1, {0, 1, 0});
  ASSERT_TRUE(measures);
  const CurlNumbers numbers = curlNumbers(*ruler, *measures);
  EXPECT_NEAR(numbers.turns, 6, 0.01);
  EXPECT_NEAR(numbers.meanRadius, 0.01, 1e-4);
  EXPECT_NEAR(numbers.droop, 0, 2e-8) << "floats, 3 cm from the origin";
  EXPECT_NEAR(numbers.coreElongation, 1, 1e-5);
  EXPECT_TRUE(numbers.handednessKept);
  EXPECT_FALSE(numbers.bounceHz || numbers.settleSeconds || numbers.energyRatio);
}

TEST(GroomMeasure, ErrorsNameTheStrand) {
  EXPECT_FALSE(GroomRuler::make(Groom{}));
  Groom broken = groomOf({cut({}, 64), Strand(5, Vec3d{1, 1, 1})});
  auto refused = GroomRuler::make(broken);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("strand 1"), std::string::npos) << refused.error().message;

  const Groom rest = groomOf({cut({}, 64), cut({}, 32)});
  auto ruler = GroomRuler::make(rest);
  ASSERT_TRUE(ruler);
  std::vector<Vec3f> points = rest.points;
  points[70].x = std::numeric_limits<float>::quiet_NaN();
  auto measures = ruler->measure(points, 1, {0, 1, 0});
  ASSERT_FALSE(measures);
  EXPECT_NE(measures.error().message.find("strand 1: particle 6"), std::string::npos)
      << measures.error().message;
}

TEST(GroomMeasure, FindsTheHeadsTurnFromItsRoots) {
  std::vector<Strand> strands;
  for (Vec3d at : {Vec3d{0.05, 0, 0}, Vec3d{-0.05, 0.01, 0}, Vec3d{0, 0, 0.06}})
    strands.push_back(moved(cut({}, 64), {}, at));
  const Groom rest = groomOf(strands);
  auto ruler = GroomRuler::make(rest);
  ASSERT_TRUE(ruler);
  const Quatd turn = turnAbout({0.48, 0.6, 0.64}, 75);
  for (Strand& strand : strands) strand = moved(strand, turn, {1, 0, -1});
  const Groom now = groomOf(strands);
  auto measures = ruler->measure(now.points, 1, {0, 1, 0}, ruler->headRotationOf(now.points, 1));
  ASSERT_TRUE(measures);
  // Positions are floats a metre from the origin: 6e-8 of it, over roots 5 cm apart, is 1e-4 degrees.
  for (const StrandMeasure& measured : *measures) {
    EXPECT_NEAR(measured.tipRotation, 0, 1e-2);
    EXPECT_NEAR(measured.droop, 0, 1e-6);
  }
}

void print(const char* name, const GroomMeasure& groom) {
  fmt::print("{}: {} strands, {} right-handed, {} left-handed\n", name, groom.strandCount,
             groom.rightHandedCount, groom.leftHandedCount);
  auto line = [](const char* what, const Spread& spread) {
    fmt::print("  {:<18}{:>10.4f}{:>10.4f}{:>10.4f}\n", what, spread.mean, spread.min, spread.max);
  };
  fmt::print("  {:<18}{:>10}{:>10}{:>10}\n", "", "mean", "min", "max");
  line("turns", groom.turns);
  line("winding", groom.winding);
  line("radius [unit]", groom.meanRadius);
  line("core [unit]", groom.coreLength);
  line("core elongation", groom.coreElongation);
  line("chord elongation", groom.chordElongation);
  line("relative droop", groom.relativeDroop);
  line("hand kept", groom.handednessKept);
  line("arc drift", groom.arcDrift);
  line("longest edge", groom.maxEdgeStretch);
  line("tip rotation [deg]", groom.tipRotation);
}

TEST(GroomMeasureOnRealHair, TightCoilsKeepTheirTurnsAsTheySettle) {
  RINGLET_NEEDS_DATA(restPath, "curlycue/frame_000.obj");
  RINGLET_NEEDS_DATA(settledPath, "curlycue/frame_070_settled.obj");
  auto rest = readGroom(restPath), settled = readGroom(settledPath);
  ASSERT_TRUE(rest && settled);
  rest->groom.metresPerUnit = 1;  // the file's is unknown; what follows is in its unit, or free of it
  auto ruler = GroomRuler::make(rest->groom);
  ASSERT_TRUE(ruler) << ruler.error().message;
  auto measures =
      ruler->measure(settled->groom.points, 1, {0, 1, 0}, ruler->headRotationOf(settled->groom.points, 1));
  ASSERT_TRUE(measures) << measures.error().message;
  const GroomMeasure before = ruler->summarize(ruler->rest()), after = ruler->summarize(*measures);
  print("frame_000", before);
  print("frame_070_settled", after);

  // About 24 turns of radius 0.54, says shared/data's README, measured by other means.
  EXPECT_NEAR(before.turns.mean, 24, 1);
  EXPECT_GT(before.turns.min, 15);
  EXPECT_NEAR(before.meanRadius.mean, 0.54, 0.03);

  // The other simulator's strands have drooped, not unwound: every one keeps its turns, its hand, its radius.
  for (std::size_t s = 0; s < measures->size(); ++s) {
    const StrandMeasure &now = (*measures)[s], then = ruler->strand(s).rest();
    EXPECT_NEAR(now.turns, then.turns, 0.2) << "strand " << s;
    EXPECT_NEAR(now.meanRadius, then.meanRadius, 0.02 * then.meanRadius) << "strand " << s;
    EXPECT_GE(now.handednessKept, kHandKeptShare) << "strand " << s;
    EXPECT_GT(now.relativeDroop, 0) << "strand " << s;
    EXPECT_NEAR(now.arcDrift, 0, 1e-3) << "strand " << s;
  }
}

}  // namespace
}  // namespace ringlet::groom_measure_test
