// Tests reference/star_join.h: any grouping gives the same system, the joined velocities are those of the
// serial elimination (reference/strand_solve.h), and float32 loses no more digits to stiffness than to
// rounding.
#include "reference/star_join.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "reference/strand_solve.h"
#include "tests/equations/strand_fixtures.h"

namespace ringlet::reference::test::star_join_test {
namespace {

using Stretch = StretchSystem<double>;

// Nearly straight, along the edges `stiffness` times the mass, across them a thousandth of that: hair.
StrandSystem hairSystem(std::size_t particleCount, double stiffness) {
  std::mt19937 random(17);
  StrandSystem system;
  for (std::size_t i = 0; i < particleCount; ++i) {
    system.masses.push_back(1 + std::abs(randomVector(random, 0.2).x()));
    system.momenta.push_back(randomVector(random, 1));
    if (i + 1 == particleCount) break;
    system.along.push_back(stiffness * (1 + std::abs(randomVector(random, 0.2).x())));
    system.across.push_back(1e-3 * stiffness);
    system.directions.push_back((Vector3<double>(0, -1, 0) + randomVector(random, 0.2)).normalized());
  }
  return system;
}

// One particle and the edge beyond it. The root's P is never used, as it is pinned.
Stretch stretchOf(const StrandSystem& system, std::size_t i) {
  const bool isTip = i + 1 == system.particleCount();
  const Matrix3<double> identity = Matrix3<double>::Identity();
  return {system.massBlock(i), system.rightSide(i), isTip ? Matrix3<double>::Zero() : identity,
          Vector3<double>::Zero(), isTip ? identity : Matrix3<double>(system.edgeBlock(i).inverse())};
}

// `run` particles a lane; lanes beyond the tip are void.
std::vector<Stretch> lanesOf(const StrandSystem& system, std::size_t laneCount, std::size_t run) {
  std::vector<Stretch> lanes;
  for (std::size_t lane = 0; lane < laneCount; ++lane) {
    Stretch sum{Matrix3<double>::Identity(), Vector3<double>::Ones(), Matrix3<double>::Zero(),
                Vector3<double>::Zero(), Matrix3<double>::Identity()};
    const std::size_t begin = lane * run, end = std::min(begin + run, system.particleCount());
    for (std::size_t i = begin; i < end; ++i)
      sum = i == begin ? stretchOf(system, i) : composed(sum, stretchOf(system, i));
    lanes.push_back(sum);
  }
  return lanes;
}

// In the units in which each part enters velocities: relative to the larger of both.
void expectNear(const Stretch& a, const Stretch& b, double tolerance) {
  EXPECT_LE((a.P - b.P).norm(), tolerance * b.P.norm());
  EXPECT_LE((a.y - b.y).norm(), tolerance * b.y.norm());
  EXPECT_LE((a.transfer - b.transfer).norm(), tolerance * b.transfer.norm());
  EXPECT_LE((a.offset - b.offset).norm(), tolerance * (b.offset.norm() + (b.H * b.y).norm()));
  EXPECT_LE((a.H - b.H).norm(), tolerance * b.H.norm());
}

Field<double> serially(const StrandSystem& system, const Vector3<double>& root) {
  Field<double> velocities(system.particleCount(), Vector3<double>::Zero());
  velocities[0] = root;
  SolveScratch scratch;
  solveStrand(system, scratch, velocities);
  return velocities;
}

const Vector3<double> kRoot(0.3, -0.2, 0.5);

TEST(StarJoin, ComposingIsAssociative) {
  for (const double stiffness : {0.1, 10.0, 1e4}) {
    const StrandSystem system = hairSystem(24, stiffness);
    const auto lanes = lanesOf(system, 3, 7);
    expectNear(composed(composed(lanes[0], lanes[1]), lanes[2]),
               composed(lanes[0], composed(lanes[1], lanes[2])), 1e-10);
  }
}

TEST(StarJoin, GivesTheSerialEliminationsVelocities) {
  for (const double stiffness : {0.1, 10.0, 1e4}) {
    for (const std::size_t laneCount : {2, 4, 8, 16, 32, 64}) {
      for (const std::size_t particleCount : {4 * laneCount, 4 * laneCount - 1, 2 * laneCount + 1}) {
        const StrandSystem system = hairSystem(particleCount, stiffness);
        const auto expected = serially(system, kRoot);
        const auto found = joinLanes(lanesOf(system, laneCount, 4), kRoot);
        for (std::size_t lane = 0; 4 * lane < particleCount; ++lane) {
          EXPECT_LE((found[lane] - expected[4 * lane]).norm(), 1e-9 * maxNorm(expected))
              << "lane " << lane << " of " << laneCount << ", " << particleCount << " particles, stiffness "
              << stiffness;
        }
      }
    }
  }
}

// The lanes' systems are rounded once; what is lost must be of that size in any number of lanes.
TEST(StarJoin, FloatKeepsItsDigitsHoweverStiff) {
  for (const std::size_t laneCount : {4, 8, 16, 32, 64}) {
    std::string line;
    for (const double stiffness : {1e1, 1e3, 1e5, 1e7}) {
      const auto exact = lanesOf(hairSystem(4 * laneCount, stiffness), laneCount, 4);
      std::vector<StretchSystem<float>> rounded;
      std::vector<Stretch> expectedOf;
      for (const Stretch& lane : exact) {
        rounded.push_back(lane.cast<float>());
        expectedOf.push_back(rounded.back().cast<double>());
      }
      const Vector3<float> root = kRoot.cast<float>();
      const auto expected = joinLanes<double>(expectedOf, root.cast<double>());
      const double error = maxDistance(joinLanes(rounded, root), expected) / maxNorm(expected);
      line += fmt::format(" {:.1e}", error);
      EXPECT_LE(error, 2e-6) << laneCount << " lanes, stiffness " << stiffness;
    }
    fmt::print("{:2} lanes, error at stiffness 1e1 1e3 1e5 1e7:{}\n", laneCount, line);
  }
}

}  // namespace
}  // namespace ringlet::reference::test::star_join_test
