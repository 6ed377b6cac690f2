// Tests reference/equations/smoothing.h against closed forms.
#include "reference/equations/smoothing.h"

#include <gtest/gtest.h>

#include <complex>

#include "tests/equations/strand_fixtures.h"

namespace ringlet::reference::test::smoothing_test {
namespace {

// Worst relative error of x - expected in the tests below, a few hundred roundings of double.
constexpr double kRounding = 1e-13;

TEST(Smoothing, WithoutLengthReturnsItsInputExactly) {
  std::mt19937 random(1);
  const Field<double> x = randomField(random, 50, 1);
  Field<double> smoothed;
  EXPECT_EQ(smoothingShare(0.004, 0), 1.0);
  smooth(x, smoothingShare(0.004, 0), randomVector(random, 1), smoothed);
  EXPECT_EQ(maxDistance(smoothed, x), 0.0);
}

TEST(Smoothing, ShareIsOneMinusExp) {
  EXPECT_NEAR(smoothingShare(0.004, 0.03), 1 - std::exp(-0.004 / 0.03), 1e-16);
  // Short edges: beta = l / alpha - (l / alpha)^2 / 2 keeps all its digits.
  EXPECT_NEAR(smoothingShare(1e-9, 1.0) / (1e-9 - 0.5e-18), 1, 1e-15);
}

TEST(Smoothing, AStraightStrandIsLeftAsItIs) {
  const Field<double> x(40, Vector3<double>(0.1, -0.2, 0.3));
  Field<double> smoothed;
  smooth(x, 0.13, x[0], smoothed);
  EXPECT_EQ(maxDistance(smoothed, x), 0.0);
}

// d_i = 2(1-beta) d_{i-1} - (1-beta)^2 d_{i-2} + beta^2 x_i, the paper's form, from d_{-1} = d_{-2} = start.
TEST(Smoothing, CascadeEqualsTheExpandedRecurrence) {
  std::mt19937 random(2);
  const double beta = 0.17;
  const Field<double> x = randomField(random, 200, 1);
  const Vector3<double> start = randomVector(random, 1);
  Field<double> smoothed, expanded;
  smooth(x, beta, start, smoothed);
  Vector3<double> before = start, twoBefore = start;
  for (const Vector3<double>& xi : x) {
    const double keep = 1 - beta;
    expanded.push_back(2 * keep * before - keep * keep * twoBefore + beta * beta * xi);
    twoBefore = before;
    before = expanded.back();
  }
  EXPECT_LT(maxDistance(smoothed, expanded), 200 * kRounding);
}

// Edges that turn by w per edge: the amplitude is multiplied by |beta^2 / (1 - (1-beta) e^{-iw})^2| =
// beta^2 / (1 - 2 (1-beta) cos w + (1-beta)^2) once the start has died away; what does not turn is left as it
// is.
TEST(Smoothing, GainOnAHelix) {
  for (const double w : {0.2, 0.8, 1.6}) {
    for (const double beta : {0.05, 0.3, 0.8}) {
      Field<double> edges, smoothed;
      for (int i = 0; i < 1000; ++i) edges.push_back({std::cos(w * i), -0.5, std::sin(w * i)});
      smooth(edges, beta, edges[0], smoothed);
      const Vector3<double> last = smoothed.back();
      const double gain = beta * beta / (1 - 2 * (1 - beta) * std::cos(w) + (1 - beta) * (1 - beta));
      EXPECT_NEAR(std::hypot(last.x(), last.z()), gain, 1e-12) << "w " << w << " beta " << beta;
      EXPECT_NEAR(last.y(), -0.5, 1e-12);
    }
  }
}

TEST(Smoothing, TransposeIsTheAdjoint) {
  std::mt19937 random(3);
  for (const double beta : {0.02, 0.4, 1.0}) {
    const Field<double> x = randomField(random, 137, 1), y = randomField(random, 137, 1);
    Field<double> smoothX, spreadY;
    smooth(x, beta, Vector3<double>::Zero(), smoothX);
    smoothTransposed(y, beta, spreadY);
    double left = 0, right = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      left += smoothX[i].dot(y[i]);
      right += x[i].dot(spreadY[i]);
    }
    EXPECT_NEAR(left, right, 1e-13 * static_cast<double>(x.size())) << "beta " << beta;
  }
}

// Why a cascade: in float it keeps its digits at any length (at most 2.2e-7 in a prototype; twice that here).
TEST(Smoothing, FloatKeepsItsDigitsOnALongStrand) {
  Field<float> x;
  Field<double> exact, smoothedExact;
  for (int i = 0; i < 1000; ++i) {
    x.push_back({std::cos(0.05f * static_cast<float>(i)), 0.3f, std::sin(0.05f * static_cast<float>(i))});
    exact.push_back(x.back().cast<double>());
  }
  Field<float> smoothed;
  const float beta = 0.02f;
  smooth(x, beta, x[0], smoothed);
  smooth(exact, static_cast<double>(beta), exact[0], smoothedExact);
  EXPECT_LT(maxDistance(smoothed, smoothedExact), 4.4e-7);
}

}  // namespace
}  // namespace ringlet::reference::test::smoothing_test
