// Tests reference/strand_solve.h against Eigen's dense solve and the eigenvalues of the iteration.
#include "reference/strand_solve.h"

#include <gtest/gtest.h>
#include <Eigen/Dense>

#include "tests/equations/strand_fixtures.h"

namespace ringlet::reference::test::strand_solve_test {
namespace {

// Along the edge `stiffness` times the mass, across it a tenth of that.
StrandSystem randomSystem(std::size_t particleCount, std::size_t rootCount, double stiffness) {
  std::mt19937 random(11);
  StrandSystem system;
  system.rootCount = rootCount;
  for (std::size_t i = 0; i < particleCount; ++i) {
    system.masses.push_back(1 + std::abs(randomVector(random, 1).x()));
    system.momenta.push_back(randomVector(random, 1));
    if (i + 1 == particleCount) break;
    system.along.push_back(stiffness * (1 + std::abs(randomVector(random, 1).x())));
    system.across.push_back(0.1 * stiffness);
    system.directions.push_back(randomVector(random, 1).normalized());
  }
  return system;
}

// Contacts at every third particle, along random normals, up to 1,000 times the mass.
void addContacts(StrandSystem& system) {
  std::mt19937 random(12);
  for (std::size_t i = 0; i < system.particleCount(); ++i) {
    const Vector3<double> normal = randomVector(random, 1).normalized();
    system.contactWeights.push_back((i % 3 == 0 ? 1000.0 : 0.0) * normal * normal.transpose());
    system.contactMomenta.push_back(system.contactWeights.back() * randomVector(random, 1));
  }
}

// The system of the free particles as one dense matrix, with what the pinned ones add to its right hand side.
struct DenseSystem {
  Eigen::MatrixXd matrix;
  Eigen::VectorXd right;
};
DenseSystem densify(const StrandSystem& system, const Field<double>& velocities) {
  const std::size_t first = system.rootCount, n = system.particleCount();
  const auto size = static_cast<Eigen::Index>(3 * (n - first));
  DenseSystem dense{Eigen::MatrixXd::Zero(size, size), Eigen::VectorXd(size)};
  for (std::size_t i = first; i < n; ++i) {
    const auto row = static_cast<Eigen::Index>(3 * (i - first));
    dense.matrix.block<3, 3>(row, row) += system.masses[i] * Matrix3<double>::Identity();
    dense.right.segment<3>(row) = system.momenta[i];
    if (system.contactWeights.empty()) continue;
    dense.matrix.block<3, 3>(row, row) += system.contactWeights[i];
    dense.right.segment<3>(row) += system.contactMomenta[i];
  }
  for (std::size_t i = first - 1; i + 1 < n; ++i) {
    const Matrix3<double> a = system.edgeBlock(i);
    const auto below = static_cast<Eigen::Index>(3 * (i + 1 - first));
    dense.matrix.block<3, 3>(below, below) += a;
    if (i < first) {
      dense.right.segment<3>(below) += a * velocities[i];
      continue;
    }
    dense.matrix.block<3, 3>(below - 3, below - 3) += a;
    dense.matrix.block<3, 3>(below - 3, below) -= a;
    dense.matrix.block<3, 3>(below, below - 3) -= a;
  }
  return dense;
}

Eigen::VectorXd flatten(const Field<double>& velocities, std::size_t first) {
  Eigen::VectorXd flat(static_cast<Eigen::Index>(3 * (velocities.size() - first)));
  for (std::size_t i = first; i < velocities.size(); ++i) {
    flat.segment<3>(static_cast<Eigen::Index>(3 * (i - first))) = velocities[i];
  }
  return flat;
}

void expectDenseSolution(const StrandSystem& system, Field<double> velocities, double stiffness) {
  const DenseSystem dense = densify(system, velocities);
  SolveScratch scratch;
  solveStrand(system, scratch, velocities);
  const Eigen::VectorXd found = flatten(velocities, system.rootCount),
                        expected = dense.matrix.llt().solve(dense.right);
  // Both solves lose the condition number times rounding.
  EXPECT_LT((found - expected).norm(), 1e-9 * expected.norm());
  EXPECT_LT((dense.matrix * found - dense.right).norm(), 1e-13 * (1 + stiffness) * expected.norm() + 1e-12);
}

TEST(StrandSolve, MatchesTheDenseSolve) {
  std::mt19937 random(5);
  for (const std::size_t particleCount : {2u, 3u, 40u}) {
    for (const std::size_t rootCount : {1u, 2u}) {
      if (particleCount <= rootCount) continue;
      for (const double stiffness : {0.0, 10.0, 1e5}) {
        StrandSystem system = randomSystem(particleCount, rootCount, stiffness);
        const Field<double> velocities = randomField(random, particleCount, 1);
        expectDenseSolution(system, velocities, stiffness);
        addContacts(system);
        expectDenseSolution(system, velocities, 1000 + stiffness);
      }
    }
  }
}

TEST(StrandSolve, ALongStiffStrandKeepsItsMass) {
  // Free fall of 1,000 particles from a moving root: momenta m v with one v everywhere, so v is the solution.
  StrandSystem system = randomSystem(1000, 1, 1e6);
  const Vector3<double> v(0.3, -0.2, 0.5);
  for (std::size_t i = 0; i < 1000; ++i) system.momenta[i] = system.masses[i] * v;
  Field<double> velocities(1000, Vector3<double>::Zero());
  velocities[0] = v;
  SolveScratch scratch;
  solveStrand(system, scratch, velocities);
  for (const Vector3<double>& found : velocities) EXPECT_LT((found - v).norm(), 1e-7);
}

TEST(StrandSolve, TheIterationBoundIsOne) {
  for (const double stiffness : {1.0, 100.0}) {
    const StrandSystem system = randomSystem(20, 1, stiffness);
    const Eigen::MatrixXd matrix = densify(system, Field<double>(20, Vector3<double>::Zero())).matrix;
    Eigen::MatrixXd diagonal = Eigen::MatrixXd::Zero(matrix.rows(), matrix.cols());
    for (Eigen::Index row = 0; row < matrix.rows(); row += 3) {
      diagonal.block<3, 3>(row, row) = matrix.block<3, 3>(row, row);
    }
    const Eigen::MatrixXd iteration =
        Eigen::MatrixXd::Identity(matrix.rows(), matrix.cols()) - diagonal.inverse() * matrix;
    const double radius = iteration.eigenvalues().cwiseAbs().maxCoeff();
    EXPECT_LT(radius, pointIterationBound(system));
    EXPECT_GT(radius, 0.5 * pointIterationBound(system));
  }
}

TEST(StrandSolve, PointIterationsConvergeToTheExactSolution) {
  std::mt19937 random(6);
  StrandSystem system = randomSystem(30, 2, 20);
  addContacts(system);
  const Field<double> start = randomField(random, 30, 1);
  SolveScratch scratch;
  Field<double> exact = start;
  solveStrand(system, scratch, exact);
  const auto error = [&](int iterationCount, bool chebyshev) {
    Field<double> velocities = start;
    iteratePoints(system, iterationCount, chebyshev, scratch, velocities);
    return maxDistance(velocities, exact);
  };
  EXPECT_LT(error(3000, false), 1e-12);
  EXPECT_LT(error(300, true), 1e-12);
  EXPECT_LT(error(40, true), 0.2 * error(40, false));
  // The first iteration is plain.
  EXPECT_EQ(error(1, true), error(1, false));
}

}  // namespace
}  // namespace ringlet::reference::test::strand_solve_test
