// measure/motion_measure.h on motions made by hand: curls that bounce, turn, ride on a head, come to rest.
#include "ringlet/measure/motion_measure.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/measure/strand_samples.h"

namespace ringlet::motion_measure_test {
namespace {

using namespace test;

constexpr double kFps = 24;

MotionMeasure motionOf(const Groom& rest, double framesPerSecond = kFps) {
  auto motion = MotionMeasure::make(rest, {.framesPerSecond = framesPerSecond});
  EXPECT_TRUE(motion) << motion.error().message;
  return std::move(*motion);
}

// Every point of the strand stretched along its core by this.
Strand stretched(Strand strand, double by) {
  for (Vec3d& p : strand) p.y *= by;
  return strand;
}

TEST(MotionMeasure, ADampedBounceHasItsFrequencyAndSettles) {
  const double frequency = 3, ratio = 0.1, natural = 2 * kPi * frequency;
  const Strand rest = cut({}, 64);
  MotionMeasure motion = motionOf(groomOf({rest}));
  for (int k = 0; k <= 240; ++k) {
    const double t = k / kFps;
    const double by = 1 + 0.08 * std::exp(-ratio * natural * t) * std::cos(natural * t);
    ASSERT_TRUE(motion.addFrame(asFloats(stretched(rest, by)), 1, Quatd{}));
  }
  const MotionReport report = motion.report();
  EXPECT_EQ(report.frameCount, 241u);
  EXPECT_NEAR(report.seconds, 10, 1e-12);
  EXPECT_EQ(report.freeSeconds, 0);
  const StrandMotion& strand = report.strands[0];
  ASSERT_TRUE(strand.bounceHz && strand.settleSeconds);
  EXPECT_NEAR(*strand.bounceHz, frequency, 0.06);
  EXPECT_NEAR(*strand.settleSeconds, std::log(100) / (ratio * natural), 0.5 / frequency + 1.5 / kFps);
  EXPECT_NEAR(strand.worst.coreElongation, 1.08, 1e-3);
  EXPECT_NEAR(strand.worst.droop, 0.25 * 0.08, 1e-6);
  EXPECT_NEAR(strand.last.coreElongation, 1, 1e-4);
  EXPECT_LT(report.energyRatio, 1e-8);
  ASSERT_EQ(report.frames.size(), 241u);
  for (int k = 0; k <= 240; ++k) {
    const double t = k / kFps;
    const double by = 0.08 * std::exp(-ratio * natural * t) * std::cos(natural * t);
    EXPECT_NEAR(report.frames[k].coreElongation, 1 + by, 1e-3) << k;
    EXPECT_NEAR(report.frames[k].droop, 0.25 * by, 1e-6) << k;
  }

  const CurlNumbers numbers = curlNumbers(motion.ruler(), report);
  EXPECT_EQ(numbers.frameCount, 241u);
  EXPECT_EQ(numbers.bounceHz, strand.bounceHz);
  EXPECT_EQ(numbers.settleSeconds, strand.settleSeconds);
  EXPECT_NEAR(numbers.worstCoreElongation, 1.08, 1e-3);
}

TEST(MotionMeasure, EnergyIsHalfMassTimesSpeedSquared) {
  // A strand sliding along its own root at a constant rate is at rest seen from there; one whose points move
  // at 1 m/s times their share of the way has 1/2 lambda S / 3.
  const Strand rest = cut({.radius = 0}, 101);
  MotionMeasure motion = motionOf(groomOf({rest}));
  for (int k = 0; k < 48; ++k)
    ASSERT_TRUE(motion.addFrame(asFloats(stretched(rest, 1 + k / kFps / 0.25)), 1, Quatd{}));
  const double whole = 0.5 * 1e-5 * 0.25 / 3;
  EXPECT_NEAR(motion.report().peakEnergy, whole, 1e-3 * whole);
  EXPECT_NEAR(motion.report().energyRatio, 1, 1e-3);
  EXPECT_EQ(motion.report().frames.front().energy, 0) << "nothing is known of the way to the first";
  for (int k = 1; k < 48; ++k) EXPECT_NEAR(motion.report().frames[k].energy, whole, 1e-3 * whole);

  // Two strands have twice as much; turns are those of what is curled.
  const Strand curl = cut({}, 101);
  MotionMeasure both = motionOf(groomOf({rest, rest, curl}));
  for (int k = 0; k < 2; ++k) {
    const Strand moved = stretched(rest, 1 + k / kFps / 0.25);
    ASSERT_TRUE(both.addFrame(groomOf({moved, moved, curl}).points, 1, Quatd{}));
  }
  const FrameMeasure frame = both.report().frames.back();
  EXPECT_NEAR(frame.energy, 2 * whole, 2e-3 * whole);
  EXPECT_NEAR(frame.droop, 2.0 / 3 / kFps, 1e-6);
  EXPECT_NEAR(frame.turns, 8, 0.01);

  // Given velocities mean the same.
  MotionMeasure given = motionOf(groomOf({rest}));
  std::vector<Vec3f> velocities;
  for (Vec3d p : rest) velocities.push_back({7, static_cast<float>(p.y / 0.25), 0});
  ASSERT_TRUE(given.addFrame(asFloats(rest), 1, Quatd{}, velocities));
  EXPECT_NEAR(given.report().peakEnergy, whole, 1e-3 * whole) << "the root's own 7 m/s do not count";
}

// The same motion seen at other frame rates has the same speeds, seconds and frequencies.
TEST(MotionMeasure, DoesNotDependOnTheFrameRate) {
  const Strand straight = cut({.radius = 0}, 101), curl = cut({}, 64);
  const double whole = 0.5 * 1e-5 * 0.25 / 3;  // as above: 1 m/s at the tip
  for (double fps : {24.0, 30.0, 60.0}) {
    SCOPED_TRACE(testing::Message() << fps << " frames per second");
    MotionMeasure sliding = motionOf(groomOf({straight}), fps);
    for (int k = 0; k <= 2 * fps; ++k)
      ASSERT_TRUE(sliding.addFrame(asFloats(stretched(straight, 1 + k / fps / 0.25)), 1, Quatd{}));
    EXPECT_NEAR(sliding.report().peakEnergy, whole, 1e-3 * whole);
    EXPECT_NEAR(sliding.report().strands[0].peakEnergy, whole, 1e-3 * whole);
    EXPECT_NEAR(sliding.report().seconds, 2, 1e-12);

    const double natural = 2 * kPi * 3, ratio = 0.1;
    MotionMeasure bouncing = motionOf(groomOf({curl}), fps);
    for (int k = 0; k <= 8 * fps; ++k) {
      const double t = k / fps - 2, by = 0.05 * std::exp(-ratio * natural * t) * std::sin(natural * t);
      const Vec3d head{t < 0 ? 0.1 * std::sin(2 * kPi * 2 * t) : 0, 0, 0};
      ASSERT_TRUE(
          bouncing.addFrame(asFloats(moved(stretched(curl, t < 0 ? 1 : 1 + by), {}, head)), 1, Quatd{}));
    }
    const MotionReport report = bouncing.report();
    EXPECT_NEAR(report.freeSeconds, 2, 1.5 / fps);
    ASSERT_TRUE(report.strands[0].bounceHz && report.strands[0].settleSeconds);
    EXPECT_NEAR(*report.strands[0].bounceHz, 3, 0.06);
    EXPECT_NEAR(*report.strands[0].settleSeconds, std::log(100) / (ratio * natural), 0.3);
  }
}

TEST(MotionMeasure, ADecayingMotionKeepsTheShareOfItsEnergyThatIsKnown) {
  // Amplitude falls as exp(-t), energy as exp(-2t): mean over the last of 4 seconds over the first interval.
  const Strand rest = cut({}, 64);
  MotionMeasure motion = motionOf(groomOf({rest}));
  for (int k = 0; k <= 96; ++k)
    ASSERT_TRUE(motion.addFrame(asFloats(stretched(rest, 1 + 0.05 * std::exp(-k / kFps))), 1, Quatd{}));
  double sum = 0;
  for (int k = 72; k < 96; ++k) sum += std::exp(-2 * k / kFps);
  EXPECT_NEAR(motion.report().energyRatio, sum / 24, 0.01 * sum / 24);
  EXPECT_FALSE(motion.report().strands[0].bounceHz) << "it does not oscillate";
}

TEST(MotionMeasure, TipRotationUnwrapsBeyondATurn) {
  const Strand rest = cut({}, 64);
  MotionMeasure motion = motionOf(groomOf({rest}));
  for (int k = 0; k <= 100; ++k)
    ASSERT_TRUE(motion.addFrame(asFloats(moved(rest, turnAbout({0, -1, 0}, 10.0 * k))), 1, Quatd{}));
  EXPECT_NEAR(motion.report().strands[0].last.tipRotation, 1000, 0.1);
  for (int k = 100; k >= -50; --k)
    ASSERT_TRUE(motion.addFrame(asFloats(moved(rest, turnAbout({0, -1, 0}, 10.0 * k))), 1, Quatd{}));
  EXPECT_NEAR(motion.report().strands[0].last.tipRotation, -500, 0.1);
  EXPECT_NEAR(motion.report().strands[0].worst.tipRotation, 1000, 0.1);
}

TEST(MotionMeasure, AHeadThatCarriesItsHairAlongMeasuresNothing) {
  // Shaken, then spun: given its rotation, or found from the roots.
  std::vector<Strand> strands;
  for (Vec3d at : {Vec3d{0.05, 0, 0}, Vec3d{-0.05, 0.01, 0}, Vec3d{0, 0, 0.06}})
    strands.push_back(moved(cut({}, 64), {}, at));
  for (bool given : {true, false}) {
    MotionMeasure motion = motionOf(groomOf(strands));
    for (int k = 0; k <= 96; ++k) {
      const Quatd turn = turnAbout({0.48, 0.6, 0.64}, 8.0 * k);
      std::vector<Strand> now;
      for (const Strand& strand : strands)
        now.push_back(moved(strand, turn, {0.1 * std::sin(0.5 * k), 0, 0}));
      ASSERT_TRUE(motion.addFrame(groomOf(now).points, 1, given ? std::optional(turn) : std::nullopt));
    }
    const MotionReport report = motion.report();
    EXPECT_NEAR(report.freeSeconds, 4, 1e-12) << "it was driven all along";
    for (const StrandMotion& strand : report.strands) {
      EXPECT_NEAR(strand.worst.tipRotation, 0, 0.01);
      EXPECT_NEAR(strand.worst.droop, 0, 1e-6);
      EXPECT_FALSE(strand.bounceHz);
      EXPECT_FALSE(strand.settleSeconds);
    }
    // 4e-8 m of rounding a frame: 1e-6 m/s against metres a second.
    EXPECT_LT(report.peakEnergy, 1e-11 * 1e-5);
  }
}

TEST(MotionMeasure, CountsFromWhereTheHeadStops) {
  // Two seconds of shaking with the hair rigid on it, then a bounce.
  const Strand rest = cut({}, 64);
  MotionMeasure motion = motionOf(groomOf({rest}));
  for (int k = 0; k <= 240; ++k) {
    const double t = k / kFps - 2, natural = 2 * kPi * 4;
    const double by = t < 0 ? 1 : 1 + 0.05 * std::exp(-0.1 * natural * t) * std::sin(natural * t);
    const Vec3d head{t < 0 ? 0.1 * std::sin(2 * kPi * 2 * t) : 0, 0, 0};
    ASSERT_TRUE(motion.addFrame(asFloats(moved(stretched(rest, by), {}, head)), 1));
  }
  const MotionReport report = motion.report();
  EXPECT_NEAR(report.freeSeconds, 2, 1.5 / kFps);
  ASSERT_TRUE(report.strands[0].bounceHz && report.strands[0].settleSeconds);
  EXPECT_NEAR(*report.strands[0].bounceHz, 4, 0.1);
  EXPECT_NEAR(*report.strands[0].settleSeconds, std::log(100) / (0.1 * 2 * kPi * 4), 0.3);

  // A head that glides at constant speed drives nothing.
  MotionMeasure gliding = motionOf(groomOf({rest}));
  for (int k = 0; k <= 48; ++k) ASSERT_TRUE(gliding.addFrame(asFloats(moved(rest, {}, {k / kFps, 0, 0})), 1));
  EXPECT_EQ(gliding.report().freeSeconds, 0);
  EXPECT_EQ(gliding.report().strands[0].settleSeconds, 0);
}

TEST(MotionMeasure, RoundingIsNoEnergy) {
  // Of a curl that trembles by a millionth of its length nothing is left, of one by a thousandth everything.
  const Strand rest = cut({}, 64);
  for (const auto& [by, left] : {std::pair{1e-6, 0.0}, std::pair{1e-3, 1.0}}) {
    MotionMeasure motion = motionOf(groomOf({rest, moved(rest, {}, {0.1, 0, 0})}));
    for (int k = 0; k < 48; ++k) {
      const Strand now = stretched(rest, 1 + by * (k % 2));
      ASSERT_TRUE(motion.addFrame(groomOf({now, moved(now, {}, {0.1, 0, 0})}).points, 1, Quatd{}));
    }
    EXPECT_NEAR(motion.report().energyRatio, left, 1e-2) << by;
    EXPECT_NEAR(motion.report().strands[1].energyRatio, left, 1e-2) << by;
    EXPECT_NEAR(*curlNumbers(motion.ruler(), motion.report()).energyRatio, left, 1e-2) << by;
  }
}

TEST(MotionMeasure, RefusesAFrameThatIsNotFiniteAndGoesOn) {
  const Strand rest = cut({}, 64);
  MotionMeasure motion = motionOf(groomOf({rest}));
  std::vector<Vec3f> points = asFloats(rest);
  ASSERT_TRUE(motion.addFrame(points, 1));
  points[9].y = std::numeric_limits<float>::infinity();
  auto refused = motion.addFrame(points, 1);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("strand 0: particle 9"), std::string::npos)
      << refused.error().message;
  ASSERT_TRUE(motion.addFrame(asFloats(rest), 1));
  EXPECT_EQ(motion.report().frameCount, 2u);
  EXPECT_EQ(motion.report().energyRatio, 0);
  EXPECT_FALSE(MotionMeasure::make(Groom{}, {}));
}

}  // namespace
}  // namespace ringlet::motion_measure_test
