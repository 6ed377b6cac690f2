// Tests ringlet/scene/wind.h. The turbulent field that its modes add up to:
// tests/equations/turbulence_test.cpp.
#include "ringlet/scene/wind.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>

namespace ringlet::test::wind_test {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

AirSettings gusty() {
  AirSettings air;
  air.wind = {3, -1, 0.5};
  air.gust = 1.5;
  air.gustSeconds = 0.8;
  return air;
}

// s of evenWindAt, from the wind it gives.
double swellAt(const AirSettings& air, double t) {
  return (dot(evenWindAt(air, t), air.wind) / dot(air.wind, air.wind) - 1) / air.gust;
}

TEST(WindModes, LieBetweenTheLargestEddiesAndAQuarterOfThem) {
  AirSettings air;
  EXPECT_TRUE(windModes(air).empty());
  air.turbulence = 2;
  air.eddySize = 0.3;
  const auto modes = windModes(air);
  ASSERT_EQ(modes.size(), std::size_t(kWindModeCount));
  const double smallest = kTurn / 0.3;
  EXPECT_NEAR(length(modes.front().wave), smallest, 1e-12 * smallest);
  EXPECT_NEAR(length(modes.back().wave), 4 * smallest, 1e-11 * smallest);
  for (std::size_t j = 0; j < modes.size(); ++j) {
    const double k = length(modes[j].wave);
    EXPECT_NEAR(k / smallest, std::pow(4, static_cast<double>(j) / 11), 1e-11);
    EXPECT_NEAR(dot(modes[j].wave, modes[j].amplitude), 0, 1e-14 * k * length(modes[j].amplitude));
    EXPECT_NEAR(std::abs(modes[j].frequency), 2 * k, 1e-12 * k);
    EXPECT_GE(modes[j].phase, 0);
    EXPECT_LT(modes[j].phase, kTurn);
    // Kolmogorov, three by three: amplitudes fall as the cube root of the wave number in the middle.
    const std::size_t middle = j - j % 3 + 1;
    EXPECT_NEAR(length(modes[j].amplitude) / length(modes[1].amplitude),
                std::cbrt(length(modes[1].wave) / length(modes[middle].wave)), 1e-12);
  }
}

TEST(WindModes, AreInProportionAndTurnEitherWay) {
  AirSettings air, stronger;
  air.turbulence = 1;
  stronger.turbulence = 3;
  const auto modes = windModes(air), strong = windModes(stronger);
  for (std::size_t j = 0; j < modes.size(); ++j) {
    EXPECT_EQ(modes[j].wave, strong[j].wave);
    EXPECT_LT(length(3.0 * modes[j].amplitude - strong[j].amplitude), 1e-14);
  }
  int forward = 0, all = 0;
  for (air.seed = 0; air.seed < 100; ++air.seed) {
    for (const WindMode& mode : windModes(air)) forward += mode.frequency > 0 ? 1 : 0, ++all;
  }
  EXPECT_NEAR(forward, all / 2, 4 * std::sqrt(all) / 2);  // four standard deviations of a coin
}

TEST(WindModes, PhasesAreFolded) {
  const WindMode mode{.wave = {30, -20, 10}, .amplitude = {}, .frequency = -7, .phase = 1};
  for (const double t : {-5.0, 0.0, 0.1, 1e5}) {
    const Vec3d origin{100, 3, -50};
    const double phase = phaseAt(mode, origin, t),
                 whole = (dot(mode.wave, origin) - 7 * t + 1 - phase) / kTurn;
    EXPECT_GE(phase, 0);
    EXPECT_LT(phase, kTurn);
    EXPECT_NEAR(whole, std::round(whole), 1e-10);
  }
  // The last double below nothing would round to a whole turn.
  const WindMode below{.wave = {}, .amplitude = {}, .frequency = 0, .phase = -1e-300};
  EXPECT_EQ(phaseAt(below, {}, 0), 0);
}

TEST(EvenWind, IsExactWithoutGusts) {
  AirSettings air = gusty();
  air.gust = 0;
  for (const double t : {-3.0, 0.0, 0.123, 1e6}) EXPECT_EQ(evenWindAt(air, t), air.wind);
}

// Bounds, mean, and a crest every gustSeconds: by counting over ten thousand of them.
TEST(EvenWind, GustsAreBoundedAndComeAsOftenAsAsked) {
  for (const std::uint32_t seed : {1u, 2u, 3u}) {
    AirSettings air = gusty();
    air.seed = seed;
    const double h = air.gustSeconds / 60;
    const int count = 10000 * 60;
    double mean = 0, least = 1, most = 0, before = swellAt(air, -h), now = swellAt(air, 0);
    int crests = 0;
    for (int i = 1; i <= count; ++i) {
      const double next = swellAt(air, i * h);
      EXPECT_LT(length(cross(evenWindAt(air, i * h), air.wind)), 1e-12);
      if (now > before && now >= next) ++crests;
      mean += now / count;
      least = std::min(least, now);
      most = std::max(most, now);
      before = now;
      now = next;
    }
    std::printf("seed %u: s from %.4f to %.4f, mean %.4f, a crest every %.4f gustSeconds\n", seed, least,
                most, mean, 10000.0 / crests);
    EXPECT_GE(least, -1e-12);
    EXPECT_LE(most, 1 + 1e-12);
    EXPECT_LT(least, 0.01);
    EXPECT_GT(most, 0.99);
    EXPECT_NEAR(mean, 0.5, 0.01);  // 30,000 numbers of deviation 0.29: 0.0017
    EXPECT_NEAR(10000.0 / crests, 1, 0.02);
  }
}

// Differences shrink with h, and so do those of the slope: no jumps in either, at the ends of cells too.
TEST(EvenWind, GustsAreSmooth) {
  const AirSettings air = gusty();
  const double cell = air.gustSeconds / 3;
  const auto slopeAt = [&](double t, double h) {
    return (swellAt(air, t + h) - swellAt(air, t - h)) / (2 * h);
  };
  // Of x^3 (6 x^2 - 15 x + 10) the greatest slope is 15 / 8, the greatest curvature 10 / sqrt(3).
  const double steepest = 15.0 / 8 / cell, most = 10 / std::sqrt(3.0) / (cell * cell);
  const double h = 1e-4 * cell;
  double slopeSeen = 0;
  for (int i = 0; i < 30000; ++i) {
    const double t = (i - 10000) * 0.01 * cell;  // every hundredth one is the end of a cell
    EXPECT_LE(std::abs(swellAt(air, t + h) - swellAt(air, t)), 1.001 * steepest * h) << t;
    EXPECT_LE(std::abs(slopeAt(t + h, h / 10) - slopeAt(t, h / 10)), 1.01 * most * h) << t;
    slopeSeen = std::max(slopeSeen, std::abs(slopeAt(t, h)));
  }
  EXPECT_GT(slopeSeen, 0.8 * steepest);
}

TEST(EvenWind, IsTheSameForTheSameSeedOnly) {
  AirSettings air = gusty(), other = gusty();
  other.seed = 2;
  double difference = 0;
  for (int i = 0; i < 1000; ++i) {
    const double t = 0.37 * i;
    EXPECT_EQ(evenWindAt(air, t), evenWindAt(AirSettings(air), t));
    difference += std::pow(swellAt(air, t) - swellAt(other, t), 2) / 1000;
  }
  EXPECT_GT(difference, 0.05);
}

}  // namespace
}  // namespace ringlet::test::wind_test
