// The velocity system of one strand, section 5's implicit form, solved exactly and by point
// iterations. Mirrors shaders/equations/eliminate_edge.glsl, shaders/scan/star_join.glsl (whose own order is
// that of reference/star_join.h), shaders/integrators/two_way.glsl and shaders/baselines/point_jacobi.glsl:
// there by a factorization that stays exact in float, here by the textbook one.
//
//     m_i v_i + A_i (v_i - v_{i+1}) + A_{i-1} (v_i - v_{i-1}) = r_i       free i;  no edge beyond the tip
//     A_i = a_b I + a_s e^ e^T                                            a_b, a_s [kg]
//
// With contacts, m_i I and r_i include their terms; see kernels/contact_step.h.
// Only neighbours couple: block tridiagonal, 3x3 blocks, symmetric positive definite. Pinned particles are
// known and stand on the right hand side.
#pragma once

#include <Eigen/Cholesky>
#include <vector>

#include "reference/fields.h"

namespace ringlet::reference {

/// One strand's system, in double whatever the simulation's Real: A is many thousand times m, and in float
/// D_i = m_i I + A_i + A_{i-1} has lost m before the elimination could cancel A; an iteration would add up
/// its rounding. Masses and right hand side per particle, the rest per edge.
struct StrandSystem {
  std::size_t rootCount = 1;
  Scalars<double> masses;         // m_i [kg]
  Scalars<double> across, along;  // a_b, a_s [kg]
  Field<double> directions;       // e^_i [1]
  Field<double> momenta;          // r_i [kg m/s]

  // What contacts add to m_i I [kg] and to r_i [kg m/s]; empty without.
  std::vector<Matrix3<double>> contactWeights;
  Field<double> contactMomenta;

  // The terms of the air; empty without air.
  std::vector<Matrix3<double>> airWeights;
  Field<double> airMomenta;

  std::size_t particleCount() const { return masses.size(); }
  Matrix3<double> massBlock(std::size_t i) const;
  Vector3<double> rightSide(std::size_t i) const;
  Matrix3<double> edgeBlock(std::size_t i) const;
  /// m_i I + A_i + A_{i-1}, for a free particle.
  Matrix3<double> particleBlock(std::size_t i) const;
};

/// Memory the solves need, kept between steps.
struct SolveScratch {
  std::vector<Eigen::LLT<Matrix3<double>>> blocks;
  Field<double> reduced, older, newer;
};

/// Exact: block Cholesky from the root,
///     S_i = D_i - A_{i-1} S_{i-1}^-1 A_{i-1},   y_i = r_i + A_{i-1} S_{i-1}^-1 y_{i-1},
///     then v_i = S_i^-1 (y_i + A_i v_{i+1})
/// A strand without a root begins with S_0 = D_0. velocities: pinned ones given, free ones found [m/s].
void solveStrand(const StrandSystem& system, SolveScratch& scratch, FieldView<double> velocities);

/// A bound on the spectral radius of the plain point iteration [1]: with lambda_i the largest eigenvalue of
/// A_i + A_{i-1} or more, |D_i^-1 (A_i + A_{i-1})| <= lambda_i / (m_i + lambda_i).
double pointIterationBound(const StrandSystem& system);

/// Point Jacobi: all free particles at once, v_i <- D_i^-1 (r_i + A_i v_{i+1} + A_{i-1} v_{i-1}),
/// `iterationCount` times, written as a correction by the residual. Chebyshev-accelerated (Golub and Varga
/// 1961; for Jacobi, Wang 2015): v^{k+1} = w_{k+1} (J v^k - v^{k-1}) + v^{k-1}, w_1 = 1, w_2 = 2 / (2 -
/// mu^2), w_{k+1} = 4 / (4 - mu^2 w_k). velocities: the start, and pinned ones [m/s].
void iteratePoints(const StrandSystem& system, int iterationCount, bool chebyshev, SolveScratch& scratch,
                   Field<double>& velocities);

}  // namespace ringlet::reference
