// Strands and states the equation tests share, and the few ways they look at a simulation.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "reference/step.h"
#include "ringlet/groom/groom.h"

namespace ringlet::reference::test {

inline constexpr double kPi = std::numbers::pi;

/// A helix that hangs down from the origin, axis along -y, off the axis by its radius.
struct Helix {
  double radius = 0.01;  // [m]
  double turns = 8;
  double height = 0.25;  // along the axis [m]
  int particleCount = 64;

  Vec3d at(double s) const {  // s in [0, 1]
    const double angle = 2 * kPi * turns * s;
    return {radius * std::cos(angle), -height * s, radius * std::sin(angle)};
  }
  std::vector<Vec3f> points() const {
    std::vector<Vec3f> result;
    for (int i = 0; i < particleCount; ++i) {
      result.push_back(static_cast<Vec3f>(at(static_cast<double>(i) / (particleCount - 1))));
    }
    return result;
  }
};

/// A straight strand from the origin.
inline std::vector<Vec3f> straightStrand(Vec3d end, int particleCount) {
  std::vector<Vec3f> points;
  for (int i = 0; i < particleCount; ++i)
    points.push_back(static_cast<Vec3f>(end * (1.0 * i / (particleCount - 1))));
  return points;
}

/// A groom of one strand, points in metres.
inline Groom groomOf(const std::vector<Vec3f>& points) {
  Groom groom;
  groom.metresPerUnit = 1;
  groom.addStrand(points);
  return groom;
}

template <class Real = double>
RestStrand<Real> restOf(const std::vector<Vec3f>& points, const Settings& settings = {},
                        const Material& material = {}) {
  return makeRestStrand<Real>(points, 1.0, material, PaperMaterial{}, settings);
}

inline Vector3<double> randomVector(std::mt19937& random, double size) {
  std::uniform_real_distribution<double> uniform(-size, size);
  const double x = uniform(random), y = uniform(random);
  return {x, y, uniform(random)};
}
inline Field<double> randomField(std::mt19937& random, std::size_t count, double size) {
  Field<double> field;
  for (std::size_t i = 0; i < count; ++i) field.push_back(randomVector(random, size));
  return field;
}
inline Rotation<double> randomRotation(std::mt19937& random) {
  return Rotation<double>(
      Eigen::AngleAxisd(randomVector(random, 3).norm(), randomVector(random, 1).normalized()));
}
inline Quatd toQuat(const Rotation<double>& q) { return {q.x(), q.y(), q.z(), q.w()}; }

/// Largest distance between two fields, in double.
template <class A, class B>
double maxDistance(const Field<A>& a, const Field<B>& b) {
  EXPECT_EQ(a.size(), b.size());
  double distance = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    distance = std::max(distance, (a[i].template cast<double>() - b[i].template cast<double>()).norm());
  }
  return distance;
}
template <class Real>
double maxNorm(const Field<Real>& a) {
  double norm = 0;
  for (const auto& v : a) norm = std::max(norm, static_cast<double>(v.norm()));
  return norm;
}

/// Outer steps with the head where `poseAt` says, t seconds after the start.
template <class Real, class PoseAt>
void simulate(Simulation<Real>& simulation, double seconds, PoseAt poseAt) {
  const double T = simulation.settings().stepSeconds();
  const int stepCount = static_cast<int>(std::lround(seconds / T));
  for (int n = 1; n <= stepCount; ++n) {
    const HeadPose pose = poseAt(n * T);
    simulation.stepFrame(std::span(&pose, 1));
  }
}
template <class Real>
void simulateStill(Simulation<Real>& simulation, double seconds) {
  simulate(simulation, seconds, [head = simulation.head()](double) { return head; });
}

}  // namespace ringlet::reference::test
