// The join of a strand's lanes, in the order of shaders/scan/star_join.glsl, whose head derives it. Templated
// on Real, so that a test can see what float32 loses. The step's own solve, reference/strand_solve.h, is
// another algorithm.
#pragma once

#include <Eigen/LU>
#include <vector>

#include "reference/fields.h"

namespace ringlet::reference {

/// A stretch of a strand: P v_A = y + g + Psi^T f,  v_B = Psi v_A + z + H f. v_A: its first particle's
/// velocity, v_B: the first beyond it; g pulls on the first, f is the force across the edge beyond its end.
template <class Real>
struct StretchSystem {
  Matrix3<Real> P;         // [kg]
  Vector3<Real> y;         // [kg m/s]
  Matrix3<Real> transfer;  // Psi [1]; 0 where the strand ends
  Vector3<Real> offset;    // z [m/s]
  Matrix3<Real> H;         // [1/kg]

  template <class Other>
  StretchSystem<Other> cast() const {
    return {P.template cast<Other>(), y.template cast<Other>(), transfer.template cast<Other>(),
            offset.template cast<Other>(), H.template cast<Other>()};
  }
};

/// v_B = M v_A + c, and the force across f = Y (s - Psi v_A).
template <class Real>
struct Boundary {
  Matrix3<Real> inverseP, Y, M;
  Vector3<Real> s, c;

  Boundary(const StretchSystem<Real>& a, const Matrix3<Real>& PBeyond, const Vector3<Real>& yBeyond)
      : inverseP(PBeyond.inverse()),
        Y((inverseP + a.H).inverse()),
        M(inverseP * (Y * a.transfer)),
        s(inverseP * yBeyond - a.offset),
        c(inverseP * (yBeyond - Y * s)) {}
};

/// The same for both stretches, `b` beyond `a`. Associative.
template <class Real>
StretchSystem<Real> composed(const StretchSystem<Real>& a, const StretchSystem<Real>& b) {
  const Boundary<Real> between(a, b.P, b.y);
  const Matrix3<Real> Z = between.inverseP * between.Y * a.H;
  return {a.P + a.transfer.transpose() * between.Y * a.transfer,
          a.y + a.transfer.transpose() * between.Y * between.s, b.transfer * between.M,
          b.offset + b.transfer * between.c, b.H + b.transfer * Z * b.transfer.transpose()};
}

/// Velocities of the lanes' first particles, from the root's. The lanes' number is a power of two; the last
/// one's transfer is 0. Stretches are doubled until four make the strand; P and y, and then velocities, are
/// carried over these.
template <class Real>
Field<Real> joinLanes(const std::vector<StretchSystem<Real>>& lanes, const Vector3<Real>& rootVelocity) {
  const std::size_t n = lanes.size(), stretch = n > 4 ? n / 4 : 1;
  const auto tipward = [n](std::size_t i, std::size_t by) { return i + by < n ? i + by : i; };
  std::vector<StretchSystem<Real>> systems = lanes;
  for (std::size_t by = 1; by < stretch; by *= 2) {
    const auto before = systems;
    for (std::size_t i = 0; i < n; ++i) systems[i] = composed(before[i], before[tipward(i, by)]);
  }
  auto whole = systems;
  for (std::size_t by = stretch; by < n; by += stretch) {
    const auto before = whole;
    for (std::size_t i = 0; i < n; ++i) whole[i] = composed(systems[i], before[tipward(i, stretch)]);
  }

  // Lane i's map leads to lane i + 1.
  std::vector<Matrix3<Real>> M;
  Field<Real> c;
  for (std::size_t i = 0; i < n; ++i) {
    const auto& beyond = whole[tipward(i, 1)];
    const Boundary<Real> boundary(lanes[i], beyond.P, beyond.y);
    M.push_back(i == 0 ? Matrix3<Real>::Zero() : boundary.M);
    c.push_back(i == 0 ? Vector3<Real>(boundary.M * rootVelocity + boundary.c) : boundary.c);
  }
  const auto rootward = [](std::size_t i, std::size_t by) { return i >= by ? i - by : i; };
  for (std::size_t by = 1; by < stretch; by *= 2) {
    const auto MBefore = M;
    const auto cBefore = c;
    for (std::size_t i = 0; i < n; ++i) {
      c[i] = MBefore[i] * cBefore[rootward(i, by)] + cBefore[i];
      M[i] = MBefore[i] * MBefore[rootward(i, by)];
    }
  }
  Field<Real> next = c;
  for (std::size_t by = stretch; by < n; by += stretch) {
    const Field<Real> before = next;
    for (std::size_t i = 0; i < n; ++i) next[i] = M[i] * before[rootward(i, stretch)] + c[i];
  }
  Field<Real> velocities{rootVelocity};
  for (std::size_t i = 0; i + 1 < n; ++i) velocities.push_back(next[i]);
  return velocities;
}

}  // namespace ringlet::reference
