// Tests reference/equations/turbulence.h, with the modes of ringlet/scene/wind.h.
#include "reference/equations/turbulence.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "tests/equations/strand_fixtures.h"

namespace ringlet::reference::test::turbulence_test {
namespace {

const Vector3<double> kOrigin = Vector3<double>::Zero();

AirSettings turbulent(double turbulence, std::uint32_t seed = 1) {
  AirSettings air;
  air.turbulence = turbulence;
  air.seed = seed;
  return air;
}

// Column j: how the wind changes with x_j, by central differences [1/s].
Matrix3<double> gradientAt(const std::vector<WindMode>& modes, const Vector3<double>& x, double t, double h) {
  Matrix3<double> gradient;
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3<double> shift = h * Vector3<double>::Unit(axis);
    const Vector3<double> more = x + shift, less = x - shift;
    gradient.col(axis) =
        (turbulentWind<double>(modes, kOrigin, t, more) - turbulentWind<double>(modes, kOrigin, t, less)) /
        (2 * h);
  }
  return gradient;
}

TEST(Turbulence, HasNoDivergence) {
  std::mt19937 random(1);
  double worst = 0;
  for (const std::uint32_t seed : {1u, 2u, 3u}) {
    const AirSettings air = turbulent(1.5, seed);
    const auto modes = windModes(air);
    std::vector<Matrix3<double>> gradients;
    double meanSquare = 0;
    for (int place = 0; place < 1000; ++place) {
      // h: 2e-4 of the smallest eddies' length, which the differences are wrong by the square of.
      const double t = 10 + randomVector(random, 10).x();
      gradients.push_back(gradientAt(modes, randomVector(random, 3), t, 1e-5));
      meanSquare += gradients.back().squaredNorm() / 1000;
    }
    for (const Matrix3<double>& gradient : gradients) {
      worst = std::max(worst, std::abs(gradient.trace()) / std::sqrt(meanSquare));
    }
  }
  std::printf("largest |div w| over the rms gradient: %.2e\n", worst);
  RecordProperty("divergence", std::to_string(worst));
  EXPECT_LT(worst, 1e-5);
}

// Over many places and times, and by the modes: sum of a a^T / 2 is turbulence^2 in all directions.
TEST(Turbulence, EachComponentHasTheStrengthAskedFor) {
  std::mt19937 random(2);
  double worst = 0;
  for (const std::uint32_t seed : {1u, 2u, 3u, 4u}) {
    const AirSettings air = turbulent(0.7, seed);
    const auto modes = windModes(air);
    Matrix3<double> expected = Matrix3<double>::Zero(), measured = Matrix3<double>::Zero();
    for (const WindMode& mode : modes) {
      expected += toEigen<double>(mode.amplitude) * toEigen<double>(mode.amplitude).transpose() / 2;
    }
    EXPECT_LT((expected - 0.49 * Matrix3<double>::Identity()).norm(), 1e-14);
    const int count = 20000;
    for (int i = 0; i < count; ++i) {
      const double t = 50 + randomVector(random, 50).x();
      const Vector3<double> x = randomVector(random, 20), w = turbulentWind<double>(modes, kOrigin, t, x);
      measured += w * w.transpose() / count;
    }
    for (int axis = 0; axis < 3; ++axis) {
      worst = std::max(worst, std::abs(std::sqrt(measured(axis, axis)) / air.turbulence - 1));
      const double mixed = measured(axis, (axis + 1) % 3) / (air.turbulence * air.turbulence);
      EXPECT_LT(std::abs(mixed), 0.05) << "seed " << seed;  // no direction is preferred
    }
  }
  std::printf("largest error of a component's rms: %.2f %%\n", 100 * worst);
  RecordProperty("rms_error", std::to_string(worst));
  EXPECT_LT(worst, 0.05);
}

// How fast the wind changes along each axis: alike, as far as twelve directions can be.
TEST(Turbulence, IsMuchTheSameInAllDirections) {
  double worst = 0;
  for (std::uint32_t seed = 1; seed <= 100; ++seed) {
    Matrix3<double> waves = Matrix3<double>::Zero();
    Vector3<double> sum = Vector3<double>::Zero();
    for (const WindMode& mode : windModes(turbulent(1, seed))) {
      waves += toEigen<double>(mode.wave) * toEigen<double>(mode.wave).transpose() *
               dot(mode.amplitude, mode.amplitude);
      sum += toEigen<double>(mode.wave).normalized();
    }
    const Vector3<double> rates = waves.diagonal().cwiseSqrt();
    worst = std::max(worst, rates.maxCoeff() / rates.minCoeff());
  }
  std::printf("largest ratio of two axes' rates of change, of 100 seeds: %.3f\n", worst);
  RecordProperty("anisotropy", std::to_string(worst));
  EXPECT_LT(worst, 1.4);
}

TEST(Turbulence, IsTheSameForTheSameSeedOnly) {
  std::mt19937 random(3);
  const auto one = windModes(turbulent(1, 7)), again = windModes(turbulent(1, 7)),
             other = windModes(turbulent(1, 8));
  double difference = 0;
  for (int i = 0; i < 100; ++i) {
    const Vector3<double> x = randomVector(random, 2);
    const Vector3<double> w = turbulentWind<double>(one, kOrigin, 3, x);
    EXPECT_EQ(w, turbulentWind<double>(again, kOrigin, 3, x));
    difference += (w - turbulentWind<double>(other, kOrigin, 3, x)).squaredNorm() / 100;
  }
  EXPECT_GT(difference, 3);  // two fields without relation: 6
}

// The rate by the formula, against differences of the wind in time; and a frame's change is small.
TEST(Turbulence, IsSmoothInTime) {
  std::mt19937 random(4);
  const AirSettings air = turbulent(1);
  const auto modes = windModes(air);
  for (int i = 0; i < 100; ++i) {
    const Vector3<double> x = randomVector(random, 2);
    const double t = 10 + randomVector(random, 10).x(), h = 1e-6;
    Vector3<double> rate = Vector3<double>::Zero();
    double largest = 0;
    for (const WindMode& mode : modes) {
      const double angle = toEigen<double>(mode.wave).dot(x) + mode.frequency * t + mode.phase;
      rate -= mode.frequency * std::sin(angle) * toEigen<double>(mode.amplitude);
      largest += std::abs(mode.frequency) * length(mode.amplitude);
    }
    const Vector3<double> difference =
        turbulentWind<double>(modes, kOrigin, t + h, x) - turbulentWind<double>(modes, kOrigin, t - h, x);
    EXPECT_LT((difference / (2 * h) - rate).norm(), 1e-6 * largest);
  }
}

// As the device has it: places relative to a head far away in float, the rest folded into the phase.
TEST(Turbulence, FloatNearAFarHeadIsDouble) {
  std::mt19937 random(5);
  const AirSettings air = turbulent(1);
  const auto modes = windModes(air);
  double reference = 0, host = 0;
  for (int i = 0; i < 1000; ++i) {
    const Vector3<double> origin = 100 * randomVector(random, 1).normalized();
    const double t = 1000 + randomVector(random, 1000).x();
    const Vector3<float> x = randomVector(random, 0.5).cast<float>();
    const Vector3<double> place = origin + x.cast<double>();
    const Vector3<double> exact = turbulentWind<double>(modes, kOrigin, t, place);
    const Vector3<float> near = turbulentWind<float>(modes, origin, t, x);
    Vector3<float> folded = Vector3<float>::Zero();
    for (const WindMode& mode : modes) {
      const auto phase = static_cast<float>(phaseAt(mode, {origin.x(), origin.y(), origin.z()}, t));
      folded += std::cos(toEigen<float>(mode.wave).dot(x) + phase) * toEigen<float>(mode.amplitude);
    }
    reference = std::max(reference, (near.cast<double>() - exact).norm());
    host = std::max(host, (folded.cast<double>() - exact).norm());
  }
  std::printf("largest error over the rms: reference in float %.1e, with the host's phases %.1e\n", reference,
              host);
  RecordProperty("float_error", std::to_string(std::max(reference, host)));
  EXPECT_LT(reference, 1e-4);
  EXPECT_LT(host, 1e-4);
}

}  // namespace
}  // namespace ringlet::reference::test::turbulence_test
