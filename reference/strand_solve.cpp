// Implements strand_solve.h.
#include "reference/strand_solve.h"

#include <algorithm>

namespace ringlet::reference {

Matrix3<double> StrandSystem::massBlock(std::size_t i) const {
  Matrix3<double> block = masses[i] * Matrix3<double>::Identity();
  if (!contactWeights.empty()) block += contactWeights[i];
  if (!airWeights.empty()) block += airWeights[i];
  return block;
}

Vector3<double> StrandSystem::rightSide(std::size_t i) const {
  Vector3<double> sum = momenta[i];
  if (!contactMomenta.empty()) sum += contactMomenta[i];
  if (!airMomenta.empty()) sum += airMomenta[i];
  return sum;
}

Matrix3<double> StrandSystem::edgeBlock(std::size_t i) const {
  return across[i] * Matrix3<double>::Identity() + along[i] * directions[i] * directions[i].transpose();
}

Matrix3<double> StrandSystem::particleBlock(std::size_t i) const {
  Matrix3<double> block = massBlock(i);
  if (i > 0) block += edgeBlock(i - 1);
  if (i + 1 < particleCount()) block += edgeBlock(i);
  return block;
}

void solveStrand(const StrandSystem& system, SolveScratch& scratch, FieldView<double> velocities) {
  const std::size_t n = system.particleCount(), first = system.rootCount;
  if (n <= first) return;
  scratch.blocks.resize(n, Eigen::LLT<Matrix3<double>>(Matrix3<double>::Identity()));
  scratch.reduced.resize(n);
  auto& pivots = scratch.blocks;
  Field<double>& y = scratch.reduced;

  for (std::size_t i = first; i < n; ++i) {
    const Matrix3<double> above = i > 0 ? system.edgeBlock(i - 1) : Matrix3<double>::Zero();
    Matrix3<double> pivot = system.particleBlock(i);
    y[i] = system.rightSide(i);
    if (i == first) {
      if (i > 0) y[i] += above * velocities[i - 1];
    } else {
      pivot -= above * pivots[i - 1].solve(above);
      y[i] += above * pivots[i - 1].solve(y[i - 1]);
    }
    pivots[i].compute(pivot);
  }
  for (std::size_t i = n; i-- > first;) {
    if (i + 1 < n) y[i] += system.edgeBlock(i) * velocities[i + 1];
    velocities[i] = pivots[i].solve(y[i]);
  }
}

double pointIterationBound(const StrandSystem& system) {
  double bound = 0;
  for (std::size_t i = system.rootCount; i < system.particleCount(); ++i) {
    double lambda = system.across[i - 1] + system.along[i - 1];
    if (i + 1 < system.particleCount()) lambda += system.across[i] + system.along[i];
    bound = std::max(bound, lambda / (system.masses[i] + lambda));
  }
  return bound;
}

void iteratePoints(const StrandSystem& system, int iterationCount, bool chebyshev, SolveScratch& scratch,
                   Field<double>& velocities) {
  const std::size_t n = system.particleCount(), first = system.rootCount;
  if (n <= first) return;
  scratch.blocks.resize(n, Eigen::LLT<Matrix3<double>>(Matrix3<double>::Identity()));
  for (std::size_t i = first; i < n; ++i) scratch.blocks[i].compute(system.particleBlock(i));
  scratch.older = scratch.newer = velocities;

  const double mu = pointIterationBound(system);
  double omega = 1;
  for (int k = 1; k <= iterationCount; ++k) {
    if (chebyshev && k == 2) omega = 2 / (2 - mu * mu);
    if (chebyshev && k > 2) omega = 4 / (4 - mu * mu * omega);
    for (std::size_t i = first; i < n; ++i) {
      const Vector3<double>& v = velocities[i];
      Vector3<double> residual = system.rightSide(i) - system.massBlock(i) * v;
      residual += system.edgeBlock(i - 1) * (velocities[i - 1] - v);
      if (i + 1 < n) residual += system.edgeBlock(i) * (velocities[i + 1] - v);
      const Vector3<double> plain = v + scratch.blocks[i].solve(residual);
      scratch.newer[i] = omega * (plain - scratch.older[i]) + scratch.older[i];
    }
    scratch.older = velocities;
    velocities = scratch.newer;
  }
}

}  // namespace ringlet::reference
