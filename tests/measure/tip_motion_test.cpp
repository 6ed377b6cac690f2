// measure/tip_motion.h against damped oscillations, whose frequency and settling time are known.
#include "ringlet/measure/tip_motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/measure/strand_samples.h"

namespace ringlet::tip_motion_test {
namespace {

using test::kPi;
constexpr double kFps = 24;

// A release from `amplitude`: undamped frequency [Hz], damping ratio, as many seconds.
std::vector<double> release(double amplitude, double frequency, double ratio, double seconds) {
  const double natural = 2 * kPi * frequency, damped = natural * std::sqrt(1 - ratio * ratio);
  std::vector<double> signal;
  for (int k = 0; k <= std::lround(seconds * kFps); ++k) {
    const double t = k / kFps;
    signal.push_back(amplitude * std::exp(-ratio * natural * t) *
                     (std::cos(damped * t) + ratio * natural / damped * std::sin(damped * t)));
  }
  return signal;
}

std::vector<Vec3d> along(const std::vector<double>& signal, Vec3d direction, Vec3d from) {
  std::vector<Vec3d> path;
  for (double value : signal) path.push_back(from + direction * value);
  return path;
}

TEST(StrongestFrequency, OfADampedOscillation) {
  for (double frequency : {0.8, 1.7, 3.0, 5.0, 8.3}) {
    for (double ratio : {0.0, 0.02, 0.05, 0.1, 0.2}) {
      for (double seconds : {4.0, 10.0}) {
        const auto found = strongestFrequency(release(0.01, frequency, ratio, seconds), kFps);
        ASSERT_TRUE(found) << frequency << " Hz, " << ratio;
        // A released oscillator's spectrum peaks within a damping ratio squared of its undamped frequency;
        // the path's own resolution is 1 / seconds, of which a few hundredths remain.
        EXPECT_NEAR(*found, frequency, (0.01 + ratio * ratio) * frequency + 0.03 / seconds)
            << frequency << " Hz, " << ratio << ", " << seconds << " s";
      }
    }
  }
}

TEST(StrongestFrequency, IsTheStrongerOfTwo) {
  auto signal = release(0.003, 1.5, 0.03, 10);
  const auto strong = release(0.01, 4, 0.05, 10);
  for (std::size_t k = 0; k < signal.size(); ++k) signal[k] += strong[k];
  EXPECT_NEAR(strongestFrequency(signal, kFps).value(), 4, 0.05);
}

TEST(StrongestFrequency, OfWhatOnlyDiesAwayIsNothing) {
  for (double decay : {0.05, 0.2, 1.0, 3.0}) {
    std::vector<double> signal;
    for (int k = 0; k < 240; ++k) signal.push_back(std::exp(-k / kFps / decay));
    EXPECT_FALSE(strongestFrequency(signal, kFps)) << decay << " s";
  }
  EXPECT_FALSE(strongestFrequency(std::vector<double>(100, 0.0), kFps));
  EXPECT_FALSE(strongestFrequency(release(1, 5, 0.05, 0.25), kFps)) << "too short";
  EXPECT_FALSE(strongestFrequency(std::vector<double>{}, kFps));
}

TEST(BounceFrequency, IsOfTheLengthAboutItsFinalMean) {
  auto lengths = release(0.02, 3, 0.08, 8);
  for (double& value : lengths) value += 0.25;
  EXPECT_NEAR(bounceFrequency(lengths, kFps, 1e-6).value(), 3, 0.04);
  EXPECT_FALSE(bounceFrequency(lengths, kFps, 0.03)) << "all of it is below what counts";
  EXPECT_FALSE(bounceFrequency(std::vector<double>(100, 0.25), kFps, 1e-6));
}

TEST(SwayFrequency, IsOfTheMotionAcrossTheAxis) {
  auto path = along(release(0.02, 1.3, 0.05, 10), {0.6, 0, 0.8}, {0, -0.25, 0});
  const auto bounce = release(0.05, 4, 0.05, 10);
  for (std::size_t k = 0; k < path.size(); ++k) path[k].y += bounce[k];
  EXPECT_NEAR(swayFrequency(path, kFps, 1e-6).value(), 1.3, 0.02);
  EXPECT_FALSE(swayFrequency(along(bounce, {0, 1, 0}, {0, -0.25, 0}), kFps, 1e-6)) << "it does not sway";
  EXPECT_FALSE(swayFrequency({}, kFps, 1e-6));
}

TEST(Settle, IsWhenTheEnvelopeFallsBelowAHundredth) {
  for (double ratio : {0.05, 0.1, 0.3}) {
    const double frequency = 3, seconds = std::log(100) / (ratio * 2 * kPi * frequency);
    const auto path = along(release(0.01, frequency, ratio, 10), {0, 1, 0}, {1, 2, 3});
    const auto settled = settleSeconds(path, kFps, 0, 1e-9);
    ASSERT_TRUE(settled);
    // The last swing that reaches the limit peaks at most half a period before the envelope crosses it;
    // frames add one of theirs.
    EXPECT_LT(*settled, seconds + 1.5 / kFps) << ratio;
    EXPECT_GT(*settled, seconds - 0.5 / frequency - 1 / kFps) << ratio;

    // Counted from where it is free.
    EXPECT_NEAR(settleSeconds(path, kFps, 5, 1e-9).value(), std::max(0.0, *settled - 5 / kFps), 1e-12);
  }
}

// A path that falls evenly crosses the limit between two frames, where a formula says, at any frame rate.
TEST(Settle, IsBetweenFrames) {
  for (double fps : {12.0, 24.0, 30.0}) {
    for (double start : {10.0, 10.3, 10.9}) {
      std::vector<Vec3d> path;  // one unit a frame down to 0 in frame `start`, then at rest
      for (int k = 0; k < 100; ++k) path.push_back({std::max(0.0, start - k), 0, 0});
      const double smallest = 2.25;  // more than a hundredth of the greatest excursion
      EXPECT_NEAR(settleSeconds(path, fps, 0, smallest).value(), (start - smallest) / fps, 1e-12)
          << fps << " frames per second, from " << start;
    }
  }
}

TEST(Settle, IsNothingForWhatGoesOn) {
  EXPECT_FALSE(settleSeconds(along(release(0.01, 3, 0, 10), {0, 1, 0}, {}), kFps, 0, 1e-9));
  EXPECT_FALSE(settleSeconds(along(release(0.01, 3, 0.3, 10), {0, 1, 0}, {}), kFps, 230, 1e-9)) << "driven";
  EXPECT_FALSE(settleSeconds({}, kFps, 0, 1e-9));
}

TEST(Settle, OfWhatRestsIsAtOnce) {
  EXPECT_EQ(settleSeconds(std::vector<Vec3d>(100, Vec3d{1, 2, 3}), kFps, 0, 1e-9), 0);
  EXPECT_EQ(settleSeconds(std::vector<Vec3d>(1, Vec3d{1, 2, 3}), kFps, 0, 1e-9), 0);
  // So does what moves less than counts.
  EXPECT_EQ(settleSeconds(along(release(1e-8, 3, 0, 10), {0, 1, 0}, {}), kFps, 0, 1e-6), 0);
}

TEST(ClosingFrames, AreASecondOrHalf) {
  EXPECT_EQ(closingFrameCount(240, 24), 24u);
  EXPECT_EQ(closingFrameCount(30, 24), 15u);
  EXPECT_EQ(closingFrameCount(1, 24), 1u);
  EXPECT_EQ(closingFrameCount(240, 0.1), 1u);
}

}  // namespace
}  // namespace ringlet::tip_motion_test
