// Tests reference/equations/air_drag.h.
#include "reference/equations/air_drag.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cstdio>

#include "tests/equations/strand_fixtures.h"

namespace ringlet::reference::test::air_drag_test {
namespace {

constexpr double kMass = 2e-6;  // [kg]
const Vector3<double> kX = Vector3<double>::UnitX(), kY = Vector3<double>::UnitY();
const Vector3<double> kGravity = -kStandardGravity * kY;

// A free particle's implicit step, as the strand's system has it: (m + D) v+ = m v + T f + D w.
Vector3<double> dragStep(const AirSettings& air, const Vector3<double>& v, const Vector3<double>& w,
                         const Vector3<double>& t, const Vector3<double>& gravity, double T) {
  const Matrix3<double> d = airDragMatrix<double>(air, v - w, t, kMass, T);
  const Matrix3<double> system = kMass * Matrix3<double>::Identity() + d;
  return system.inverse() * (kMass * v + T * kMass * gravity + d * w);
}

// Where nothing accelerates it any more. Terminal whatever the step: v+ = v solves the law itself.
TEST(AirDrag, AParticleFallsAtItsTerminalSpeed) {
  for (const double T : {0.001, 0.005, 0.1}) {
    for (const double fallSpeed : {0.5, 4.0, 20.0}) {
      for (const double alongShare : {0.02, 0.1, 1.0}) {
        AirSettings air;
        air.fallSpeed = fallSpeed;
        air.alongShare = alongShare;
        const double terminal[] = {fallSpeed, fallSpeed / std::sqrt(alongShare), fallSpeed};
        const Vector3<double> tangents[] = {kX, kY, Vector3<double>::Zero()};
        for (int k = 0; k < 3; ++k) {
          Vector3<double> v = Vector3<double>::Zero();
          // Long steps swing in: by (1 - T g / U) / (1 + T g / U) each, a third at most here.
          const int stepCount = 50 + static_cast<int>(20 * terminal[k] / (kStandardGravity * T));
          for (int n = 0; n < stepCount; ++n) {
            v = dragStep(air, v, Vector3<double>::Zero(), tangents[k], kGravity, T);
          }
          EXPECT_LT((v + terminal[k] * kY).norm(), 1e-9 * terminal[k]) << k << " " << fallSpeed << " " << T;
          EXPECT_LT((airDragAcceleration<double>(air, v, tangents[k]) + kGravity).norm(), 1e-7);
        }
      }
    }
  }
}

// v' = -(g / U^2) v^2 from v0: v0 / (1 + t v0 g / U^2). The step gives it exactly, however long it is.
TEST(AirDrag, StillAirStopsAParticleAsTheClosedFormSays) {
  const AirSettings air;
  const double strength = kStandardGravity / (air.fallSpeed * air.fallSpeed), v0 = 7, seconds = 3;
  for (const int stepCount : {1, 3, 100}) {
    const double T = seconds / stepCount;
    Vector3<double> across = v0 * kX, along = v0 * kX;
    for (int n = 0; n < stepCount; ++n) {
      across = dragStep(air, across, Vector3<double>::Zero(), kY, Vector3<double>::Zero(), T);
      along = dragStep(air, along, Vector3<double>::Zero(), kX, Vector3<double>::Zero(), T);
    }
    EXPECT_LT((across - v0 / (1 + seconds * v0 * strength) * kX).norm(), 1e-12);
    EXPECT_LT((along - v0 / (1 + seconds * v0 * strength * air.alongShare) * kX).norm(), 1e-12);
  }
}

TEST(AirDrag, StillAirNeverGivesEnergy) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 1000; ++trial) {
    AirSettings air;
    air.fallSpeed = std::pow(10, randomVector(random, 2).x());
    air.alongShare = std::abs(randomVector(random, 1).x());
    const double T = std::pow(10, randomVector(random, 3).x());
    const Vector3<double> t = randomVector(random, 1).normalized();
    Vector3<double> v = randomVector(random, 30);
    EXPECT_LE(airDragAcceleration<double>(air, v, t).dot(v), 0);
    for (int n = 0; n < 5; ++n) {
      const Vector3<double> next = dragStep(air, v, Vector3<double>::Zero(), t, Vector3<double>::Zero(), T);
      EXPECT_LE(next.norm(), v.norm() * (1 + 1e-12));
      v = next;
    }
  }
}

TEST(AirDrag, TurnsWithEverything) {
  std::mt19937 random(2);
  const AirSettings air;
  for (int trial = 0; trial < 100; ++trial) {
    const Matrix3<double> turn = randomRotation(random).toRotationMatrix();
    const Vector3<double> u = randomVector(random, 10), t = randomVector(random, 1).normalized();
    const Vector3<double> turnedU = turn * u, turnedT = turn * t, backT = -t;
    const Vector3<double> a = airDragAcceleration<double>(air, u, t);
    EXPECT_LT((airDragAcceleration<double>(air, turnedU, turnedT) - turn * a).norm(), 1e-12 * a.norm());
    EXPECT_LT((airDragAcceleration<double>(air, u, backT) - a).norm(),
              1e-15 * a.norm());  // nor has t a sense
    const Matrix3<double> d = airDragMatrix<double>(air, u, t, kMass, 0.005);
    const Matrix3<double> turned = airDragMatrix<double>(air, turnedU, turnedT, kMass, 0.005);
    EXPECT_LT((turned - turn * d * turn.transpose()).norm(), 1e-12 * d.norm());
  }
}

// However long the step and fast the particle, it comes nearer to the air's velocity and does not pass it.
TEST(AirDrag, TheImplicitStepIsBounded) {
  std::mt19937 random(3);
  AirSettings air;
  for (const double fallSpeed : {0.01, 4.0, 1000.0}) {
    air.fallSpeed = fallSpeed;
    for (int trial = 0; trial < 100; ++trial) {
      const Vector3<double> t = trial == 0 ? Vector3<double>(0, 0, 0) : randomVector(random, 1).normalized();
      const Vector3<double> v = 1000 * randomVector(random, 1).normalized(), w = randomVector(random, 50);
      const Vector3<double> before = v - w, after = dragStep(air, v, w, t, Vector3<double>::Zero(), 1.0) - w;
      EXPECT_LE(after.norm(), before.norm());
      EXPECT_GE(after.dot(t) * before.dot(t), 0);
      const Vector3<double> beforeAcross = before - t * t.dot(before), afterAcross = after - t * t.dot(after);
      EXPECT_LE(afterAcross.norm(), beforeAcross.norm() * (1 + 1e-12));
      EXPECT_GE(afterAcross.dot(beforeAcross), 0);
    }
  }
}

TEST(AirDrag, TheMatrixIsSymmetricAndPositive) {
  std::mt19937 random(4);
  const AirSettings air;
  const double T = 0.005, strength = kStandardGravity / (air.fallSpeed * air.fallSpeed);
  for (int trial = 0; trial < 100; ++trial) {
    const Vector3<double> u = randomVector(random, 10), t = randomVector(random, 1).normalized();
    const Matrix3<double> d = airDragMatrix<double>(air, u, t, kMass, T);
    EXPECT_LT((d - d.transpose()).norm(), 1e-15 * d.norm());
    const double along = std::abs(t.dot(u)), across = t.cross(u).norm();
    const double atAcross = T * kMass * strength * across;
    const double atAlong = T * kMass * strength * air.alongShare * along;
    const Eigen::SelfAdjointEigenSolver<Matrix3<double>> solver(d);
    Vector3<double> expected(atAcross, atAcross, atAlong);
    std::sort(expected.begin(), expected.end());
    EXPECT_GE(solver.eigenvalues()[0], 0);
    EXPECT_LT((solver.eigenvalues() - expected).norm(), 1e-14 * d.norm());
    // A particle without direction: the same to all sides.
    const Matrix3<double> isotropic = airDragMatrix<double>(air, u, Vector3<double>::Zero(), kMass, T);
    EXPECT_LT((isotropic - T * kMass * strength * u.norm() * Matrix3<double>::Identity()).norm(),
              1e-15 * isotropic.norm());
  }
}

// D u is the law's momentum; D itself the slope of the law with the two speeds held, and between half the
// slope of the law and all of it, since |u| u grows twice as fast along u.
TEST(AirDrag, TheMatrixIsTheLinearLawsSlope) {
  std::mt19937 random(5);
  const AirSettings air;
  const double T = 0.005, h = 1e-5, strength = kStandardGravity / (air.fallSpeed * air.fallSpeed);
  for (int trial = 0; trial < 100; ++trial) {
    const Vector3<double> u = randomVector(random, 10), t = randomVector(random, 1).normalized();
    const Matrix3<double> d = airDragMatrix<double>(air, u, t, kMass, T);
    const Vector3<double> momentum = T * kMass * airDragAcceleration<double>(air, u, t);
    EXPECT_LT((d * u + momentum).norm(), 1e-14 * momentum.norm());
    const double across = (u - t * t.dot(u)).norm(), along = std::abs(t.dot(u));
    const auto linearLaw = [&](const Vector3<double>& x) -> Vector3<double> {
      const Vector3<double> xAlong = t * t.dot(x);
      return -strength * (across * (x - xAlong) + air.alongShare * along * xAlong);
    };
    Matrix3<double> linearSlope, slope;
    for (int axis = 0; axis < 3; ++axis) {
      const Vector3<double> shift = h * Vector3<double>::Unit(axis), more = u + shift, less = u - shift;
      linearSlope.col(axis) = (linearLaw(more) - linearLaw(less)) / (2 * h);
      slope.col(axis) =
          (airDragAcceleration<double>(air, more, t) - airDragAcceleration<double>(air, less, t)) / (2 * h);
    }
    EXPECT_LT((d + T * kMass * linearSlope).norm(), 1e-8 * d.norm());
    const auto leastOf = [](const Matrix3<double>& a) {
      return Eigen::SelfAdjointEigenSolver<Matrix3<double>>(0.5 * (a + a.transpose())).eigenvalues()[0];
    };
    const Matrix3<double> fullSlope = -T * kMass * slope;
    EXPECT_GT(leastOf(fullSlope - d), -1e-7 * d.norm());
    EXPECT_GT(leastOf(2 * d - fullSlope), -1e-7 * d.norm());
  }
}

TEST(AirDrag, FloatIsDoubleRounded) {
  std::mt19937 random(6);
  const AirSettings air;
  for (int trial = 0; trial < 100; ++trial) {
    const Vector3<double> u = randomVector(random, 10), t = randomVector(random, 1).normalized();
    const Matrix3<double> d = airDragMatrix<double>(air, u, t, 1, 0.005);
    const Vector3<float> uFloat = u.cast<float>(), tFloat = t.cast<float>();
    const Matrix3<float> dFloat = airDragMatrix<float>(air, uFloat, tFloat, 1, 0.005f);
    EXPECT_LT((dFloat.cast<double>() - d).norm(), 1e-6 * d.norm());
  }
}

// A straight rod of even mass, hinged at its upper end in a level wind W, at theta from the vertical:
//
//      o----> W       across the rod: the air at W cos(theta), the weight at g sin(theta)
//       \             along it: nothing that turns it
//        \ theta      at rest (W cos(theta))^2 = U^2 sin(theta), point by point and so for any length
//
// With c = (U / W)^2: sin(theta) = (sqrt(c^2 + 4) - c) / 2.
double restAngle(const AirSettings& air) {
  const double c = std::pow(air.fallSpeed / length(air.wind), 2);
  return std::asin((std::sqrt(c * c + 4) - c) / 2);
}

// The angle at which a rod rests that the law moves: Runge-Kutta of fourth order, forces at `pointCount`
// points.
double settledAngle(const AirSettings& air, double rodLength, int pointCount, double seconds) {
  const Vector3<double> w = toEigen<double>(air.wind);
  const auto turning = [&](double angle, double rate) {  // [rad/s^2]
    const Vector3<double> t(std::sin(angle), -std::cos(angle), 0),
        across(std::cos(angle), std::sin(angle), 0);
    double torque = 0, inertia = 0;
    for (int i = 0; i < pointCount; ++i) {
      const double arm = rodLength * (i + 0.5) / pointCount;
      const Vector3<double> u = arm * rate * across - w;
      torque += arm * across.dot(airDragAcceleration<double>(air, u, t) + kGravity);
      inertia += arm * arm;
    }
    return torque / inertia;
  };
  double angle = 0, rate = 0;
  const double h = 0.002;
  for (double time = 0; time < seconds; time += h) {
    const double k1 = turning(angle, rate);
    const double rate2 = rate + h / 2 * k1, k2 = turning(angle + h / 2 * rate, rate2);
    const double rate3 = rate + h / 2 * k2, k3 = turning(angle + h / 2 * rate2, rate3);
    const double rate4 = rate + h * k3, k4 = turning(angle + h * rate3, rate4);
    angle += h / 6 * (rate + 2 * rate2 + 2 * rate3 + rate4);
    rate += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }
  EXPECT_LT(std::abs(rate), 1e-6) << "not at rest";
  return angle;
}

TEST(AirDrag, AHingedRodHangsInTheWindAsTheFormulaSays) {
  std::printf("%12s %18s %18s\n", "W / U", "formula [deg]", "settled [deg]");
  for (const double share : {0.3, 1.0, 2.0, 5.0}) {
    AirSettings air;
    air.wind = {share * air.fallSpeed, 0, 0};
    const double expected = restAngle(air);
    EXPECT_NEAR(std::pow(length(air.wind) * std::cos(expected), 2),
                std::pow(air.fallSpeed, 2) * std::sin(expected), 1e-12 * dot(air.wind, air.wind));
    const double settled = settledAngle(air, 0.2, 20, 60);
    std::printf("%12.1f %18.6f %18.6f\n", share, expected * 180 / kPi, settled * 180 / kPi);
    EXPECT_NEAR(settled, expected, 1e-6);
    EXPECT_NEAR(settledAngle(air, 0.05, 7, 60), expected, 1e-6);  // whatever its length and points
  }
}

}  // namespace
}  // namespace ringlet::reference::test::air_drag_test
