// A hair's scattering: each fit against the integral over a fibre that it stands for, energy, reciprocity.
#include "reference/equations/hair_scattering.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace ringlet::reference::hair_scattering_test {
namespace {

constexpr double kPi = std::numbers::pi;
const HairFibre kClear{Vector3<double>::Zero()};

// cos theta_d, from light across the hair to light at 66 degrees.
const std::vector<double> kHalves = {1, 0.95, 0.9, 0.8, 0.7, 0.6, 0.5, 0.4};

// Mean over a fibre's width.
template <class Of>
double overWidth(Of of) {
  constexpr int kSteps = 4000;
  double sum = 0;
  for (int k = 0; k < kSteps; ++k) sum += of(-1 + (k + 0.5) * 2 / kSteps);
  return sum / kSteps;
}

double shareOf(int p, double halfway) {
  return overWidth([&](double h) { return fibreRay(p, h, halfway).share; });
}

// Over all directions of light, by elevation and azimuth.
template <class Of>
auto overSphere(Of of) {
  constexpr int kUp = 400, kRound = 90;
  auto sum = of(0.0, 0.0) * 0.0;
  for (int a = 0; a < kUp; ++a) {
    const double in = -kPi / 2 + (a + 0.5) * kPi / kUp;
    for (int b = 0; b < kRound; ++b) sum += of(in, (b + 0.5) * kPi / kRound) * (2 * std::cos(in));
  }
  return sum * (kPi / kUp * kPi / kRound);
}

TEST(HairScattering, ALobeAlongTheHairIsNormalized) {
  for (const double v : {0.01, 0.02, 0.1, 0.4, 1.0}) {
    for (const double out : {0.0, 0.5, 1.0, -1.3}) {
      double sum = 0;
      constexpr int kSteps = 20000;
      for (int k = 0; k < kSteps; ++k) {
        const double in = -kPi / 2 + (k + 0.5) * kPi / kSteps;
        sum += alongHair(v, in, out) * std::cos(in) * kPi / kSteps;
      }
      EXPECT_NEAR(sum, 1, 1e-3) << v << " " << out;
    }
  }
}

TEST(HairScattering, SharesAreThoseOfAFibre) {
  for (const double halfway : kHalves) {
    SCOPED_TRACE(halfway);
    const HairLobes lobes = hairLobes(halfway);
    EXPECT_NEAR(meanReflectedShare(halfway), shareOf(0, halfway), 0.005);
    EXPECT_NEAR(lobes.entered, shareOf(1, halfway), 0.03);
    EXPECT_NEAR(lobes.again, shareOf(2, halfway), 0.015);
    EXPECT_NEAR(lobes.rest, 1 - shareOf(0, halfway) - shareOf(1, halfway) - shareOf(2, halfway), 0.02);
  }
}

TEST(HairScattering, LightIsAbsorbedAsInAFibre) {
  for (const double halfway : kHalves) {
    for (const double absorption : {0.05, 0.3, 1.0}) {
      for (const int p : {1, 2}) {
        const double left = overWidth([&](double h) {
          const FibreRay ray = fibreRay(p, h, halfway);
          return ray.share * std::exp(-absorption * ray.way);
        });
        const double fit = std::exp(-absorption * p * hairLobes(halfway).way);
        EXPECT_NEAR(fit, left / shareOf(p, halfway), 0.025) << halfway << " " << absorption << " " << p;
      }
    }
  }
}

// R is exact; the others are bells. Shares that lie elsewhere than in the fibre's own distribution, blurred
// by the roughness.
double misplaced(int p, double halfway, double roughness) {
  constexpr int kBins = 360;
  std::vector<double> fibre(kBins), fit(kBins);
  constexpr int kRays = 2000, kBlur = 41;
  double sum = 0;
  for (int k = 0; k < kRays; ++k) {
    const FibreRay ray = fibreRay(p, -1 + (k + 0.5) * 2 / kRays, halfway);
    for (int b = 0; b < kBlur; ++b) {
      const double z = -4 + (b + 0.5) * 8 / kBlur;
      const double phi = ray.azimuth - p * kPi + z * roughness;
      const double turns = phi / (2 * kPi) + 0.5;
      const auto bin = static_cast<std::size_t>((turns - std::floor(turns)) * kBins);
      fibre[std::min<std::size_t>(bin, kBins - 1)] += ray.share * std::exp(-z * z / 2);
      sum += ray.share * std::exp(-z * z / 2);
    }
  }
  const HairLobes lobes = hairLobes(halfway);
  const double spread = p == 1 ? lobes.spreadThrough : lobes.spreadAgain;
  double difference = 0;
  for (int k = 0; k < kBins; ++k) {
    fit[k] = bell(-kPi + (k + 0.5) * 2 * kPi / kBins, std::hypot(spread, roughness)) * 2 * kPi / kBins;
    difference += std::abs(fit[k] - fibre[k] / sum) / 2;
  }
  return difference;
}

TEST(HairScattering, LightLeavesAboutTheHairAsFromAFibre) {
  for (const double halfway : {1.0, 0.9, 0.75, 0.6}) {
    for (const double roughness : {0.2, 0.3, 0.5}) {
      EXPECT_LT(misplaced(1, halfway, roughness), 0.03) << halfway << " " << roughness;
      EXPECT_LT(misplaced(2, halfway, roughness), 0.125) << halfway << " " << roughness;
    }
  }
}

// White hair in white light is white, up to the roughness of a usual look.
TEST(HairScattering, WhiteFurnace) {
  for (const double along : {0.03, 0.06, 0.085}) {
    for (const double about : {0.2, 0.3, 0.5}) {
      HairFibre fibre = kClear;
      fibre.along = along;
      fibre.about = about;
      fibre.tilt = 0.035;
      for (const double out : {0.0, 0.3, -0.6, 0.9, -1.2}) {
        const double sum =
            overSphere([&](double in, double phi) { return scatteredByHair(fibre, in, out, phi).x(); });
        EXPECT_GT(sum, 0.9) << along << " " << about << " " << out;
        EXPECT_LT(sum, 1.0) << along << " " << about << " " << out;
      }
    }
  }
}

// Light the other way round: S is what is scattered over cos theta_i.
TEST(HairScattering, IsTheSameBackwards) {
  HairFibre fibre{{0.3, 0.5, 0.8}, 0.085, 0.3, 0.035};
  for (const double a : {-1.2, -0.5, 0.1, 0.8}) {
    for (const double b : {-0.9, 0.2, 1.1}) {
      for (const double phi : {0.1, 1.0, 2.5}) {
        const Vector3<double> forth = scatteredByHair(fibre, a, b, phi) / std::cos(a);
        const Vector3<double> back = scatteredByHair(fibre, b, a, phi) / std::cos(b);
        EXPECT_LT((forth - back).norm(), 1e-12 * (1 + forth.norm()));
      }
    }
  }
}

TEST(HairScattering, MoreAbsorptionIsDarker) {
  HairFibre dark = kClear;
  dark.absorption = {0.2, 0.6, 1.5};
  for (const double in : {-0.7, 0.0, 0.7}) {
    for (const double phi : {0.2, 1.5, 3.0}) {
      const Vector3<double> of = scatteredByHair(dark, in, -0.1, phi);
      EXPECT_GT(of.x(), of.y());
      EXPECT_GT(of.y(), of.z());
      EXPECT_LT(of.x(), scatteredByHair(kClear, in, -0.1, phi).x());
    }
  }
}

}  // namespace
}  // namespace ringlet::reference::hair_scattering_test
