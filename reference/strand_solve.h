// The velocity system of one strand, section 5's implicit form (method.md 7), solved exactly and by point
// iterations. Mirrors shaders/scan/: there by a factorization that stays exact in float, here by the textbook
// one.
//
//     m_i v_i + A_i (v_i - v_{i+1}) + A_{i-1} (v_i - v_{i-1}) = r_i       free i;  no edge beyond the tip
//     A_i = a_b I + a_s e^ e^T                                            a_b, a_s [kg]
//
// Only neighbours couple: block tridiagonal, 3x3 blocks, symmetric positive definite. Pinned particles are
// known and stand on the right hand side.
#pragma once

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <vector>

#include "reference/fields.h"

namespace ringlet::reference {

/// One strand's system. Masses and right hand side per particle, the rest per edge.
template <class Real>
struct StrandSystem {
  std::size_t rootCount = 1;
  Scalars<Real> masses;         // m_i [kg]
  Scalars<Real> across, along;  // a_b, a_s [kg]
  Field<Real> directions;       // e^_i [1]
  Field<Real> momenta;          // r_i [kg m/s]

  std::size_t particleCount() const { return masses.size(); }
  Matrix3<Real> edgeBlock(std::size_t i) const {
    return across[i] * Matrix3<Real>::Identity() + along[i] * directions[i] * directions[i].transpose();
  }
  /// m_i I + A_i + A_{i-1}, for a free particle.
  Matrix3<Real> particleBlock(std::size_t i) const {
    Matrix3<Real> block = masses[i] * Matrix3<Real>::Identity() + edgeBlock(i - 1);
    if (i + 1 < particleCount()) block += edgeBlock(i);
    return block;
  }
};

/// Memory the solves need, kept between steps.
template <class Real>
struct SolveScratch {
  std::vector<Eigen::LLT<Matrix3<double>>> pivots;
  Field<double> reduced;
  std::vector<Eigen::LLT<Matrix3<Real>>> blocks;
  Field<Real> older, newer;
};

/// Exact: block Cholesky from the root,
///     S_i = D_i - A_{i-1} S_{i-1}^-1 A_{i-1},   y_i = r_i + A_{i-1} S_{i-1}^-1 y_{i-1},   then v_i = S_i^-1
///     (y_i + A_i v_{i+1})
/// In double whatever Real is: A is many thousand times m, and in float D_i = m_i I + A_i + A_{i-1} has lost
/// m before the elimination could cancel A. velocities: pinned ones given, free ones found [m/s].
template <class Real>
void solveStrand(const StrandSystem<double>& system, SolveScratch<Real>& scratch,
                 FieldView<Real> velocities) {
  const std::size_t n = system.particleCount(), first = system.rootCount;
  if (n <= first) return;
  scratch.pivots.resize(n);
  scratch.reduced.resize(n);
  auto& pivots = scratch.pivots;
  Field<double>& y = scratch.reduced;

  for (std::size_t i = first; i < n; ++i) {
    const Matrix3<double> above = system.edgeBlock(i - 1);
    Matrix3<double> pivot = system.particleBlock(i);
    y[i] = system.momenta[i];
    if (i == first) {
      y[i] += above * velocities[i - 1].template cast<double>();
    } else {
      pivot -= above * pivots[i - 1].solve(above);
      y[i] += above * pivots[i - 1].solve(y[i - 1]);
    }
    pivots[i].compute(pivot);
  }
  Vector3<double> next = Vector3<double>::Zero();
  for (std::size_t i = n; i-- > first;) {
    if (i + 1 < n) y[i] += system.edgeBlock(i) * next;
    next = pivots[i].solve(y[i]);
    velocities[i] = next.template cast<Real>();
  }
}

/// A bound on the spectral radius of the plain point iteration [1]: with lambda_i the largest eigenvalue of
/// A_i + A_{i-1} or more, |D_i^-1 (A_i + A_{i-1})| <= lambda_i / (m_i + lambda_i).
/// In double: it is close to 1, and the iteration is as sensitive as 1 - mu is small.
template <class Real>
double pointIterationBound(const StrandSystem<Real>& system) {
  double bound = 0;
  for (std::size_t i = system.rootCount; i < system.particleCount(); ++i) {
    double lambda = double(system.across[i - 1]) + double(system.along[i - 1]);
    if (i + 1 < system.particleCount()) lambda += double(system.across[i]) + double(system.along[i]);
    bound = std::max(bound, lambda / (double(system.masses[i]) + lambda));
  }
  return bound;
}

/// Point Jacobi: all free particles at once, v_i <- D_i^-1 (r_i + A_i v_{i+1} + A_{i-1} v_{i-1}),
/// `iterationCount` times. Chebyshev-accelerated (Golub and Varga 1961; for Jacobi, Wang 2015): v^{k+1} =
/// w_{k+1} (J v^k - v^{k-1}) + v^{k-1}, w_1 = 1, w_2 = 2 / (2 - mu^2), w_{k+1} = 4 / (4 - mu^2 w_k).
/// velocities: the start, and pinned ones [m/s].
template <class Real>
void iteratePoints(const StrandSystem<Real>& system, int iterationCount, bool chebyshev,
                   SolveScratch<Real>& scratch, FieldView<Real> velocities) {
  const std::size_t n = system.particleCount(), first = system.rootCount;
  if (n <= first) return;
  scratch.blocks.resize(n);
  for (std::size_t i = first; i < n; ++i) scratch.blocks[i].compute(system.particleBlock(i));
  scratch.older.assign(velocities.begin(), velocities.end());
  scratch.newer.assign(velocities.begin(), velocities.end());

  const double mu = pointIterationBound(system);
  double omega = 1;
  for (int k = 1; k <= iterationCount; ++k) {
    if (chebyshev && k == 2) omega = 2 / (2 - mu * mu);
    if (chebyshev && k > 2) omega = 4 / (4 - mu * mu * omega);
    for (std::size_t i = first; i < n; ++i) {
      Vector3<Real> sum = system.momenta[i] + system.edgeBlock(i - 1) * velocities[i - 1];
      if (i + 1 < n) sum += system.edgeBlock(i) * velocities[i + 1];
      const Vector3<Real> plain = scratch.blocks[i].solve(sum);
      // The first update is plain, exactly: older + (plain - older) would round.
      scratch.newer[i] =
          omega == 1 ? plain : Vector3<Real>(static_cast<Real>(omega) * (plain - scratch.older[i]) + scratch.older[i]);
    }
    std::copy(velocities.begin(), velocities.end(), scratch.older.begin());
    std::copy(scratch.newer.begin(), scratch.newer.end(), velocities.begin());
  }
}

}  // namespace ringlet::reference
