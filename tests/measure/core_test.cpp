// measure/core.h: the core of a helix is its axis, however it is cut, up to both ends.
#include "ringlet/measure/core.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/measure/strand_samples.h"

namespace ringlet::core_test {
namespace {

using namespace test;

// Largest distance of a helix's core from its axis, as a share of the radius: over all particles, and over
// those at least one window from the ends.
struct CoreError {
  double anywhere = 0, inside = 0;
};
CoreError errorOf(const Helix& helix, int count) {
  const Strand strand = cut(helix, count);
  const std::vector<double> at = arcPositions(strand);
  const double window = coreWindow(measureCurl(strand), at.back());
  const std::vector<Vec3d> core = smoothCore(strand, at, window);
  CoreError error;
  for (std::size_t i = 0; i < core.size(); ++i) {
    const Vec3d axis{0, -helix.length * static_cast<double>(i) / (count - 1), 0};
    const double distance = length(core[i] - axis) / helix.radius;
    error.anywhere = std::max(error.anywhere, distance);
    if (at[i] >= window && at[i] <= at.back() - window) error.inside = std::max(error.inside, distance);
  }
  return error;
}

TEST(Core, OfAHelixIsItsAxisUpToTheEnds) {
  for (double turns : {1.0, 1.5, 2.0, 4.0, 8.0, 24.0}) {
    for (int count : {16, 32, 63, 64, 128, 256}) {
      const double perTurn = (count - 1) / turns;
      if (perTurn < 3.7) continue;
      const CoreError error = errorOf(Helix{.turns = turns}, count);
      // The header's promise. What a polyline of 4 a turn has of other frequencies falls off as the square.
      EXPECT_LT(error.inside, 0.002) << turns << " turns, " << count << " particles";
      EXPECT_LT(error.anywhere, 0.02 * std::pow(3.7 / perTurn, 2))
          << turns << " turns, " << count << " particles";
    }
  }
}

TEST(Core, IsExactWhereTurnsHoldWholeNumbersOfParticles) {
  for (int perTurn : {4, 5, 8, 31})
    EXPECT_LT(errorOf(Helix{}, 8 * perTurn + 1).anywhere, 1e-10) << perTurn << " a turn";
}

TEST(Core, OfAStraightStrandIsTheStrand) {
  for (int count : {2, 3, 50}) {
    const Strand strand = cut(Helix{.radius = 0}, count);
    const std::vector<double> at = arcPositions(strand);
    const std::vector<Vec3d> core = smoothCore(strand, at, coreWindow({}, at.back()));
    for (std::size_t i = 0; i < strand.size(); ++i) EXPECT_LT(length(core[i] - strand[i]), 1e-14);
  }
}

TEST(Core, DoesNotFavourAnEnd) {
  // Reversed, a strand has the same core reversed: no phase.
  Strand strand = cut(Helix{.turns = 5}, 40);
  for (std::size_t i = 0; i < strand.size(); ++i)
    strand[i].x += 0.03 * std::sin(0.05 * double(i) * double(i));
  const std::vector<double> at = arcPositions(strand);
  const double window = 0.2 * at.back();
  const std::vector<Vec3d> core = smoothCore(strand, at, window);
  std::ranges::reverse(strand);
  const std::vector<Vec3d> back = smoothCore(strand, arcPositions(strand), window);
  for (std::size_t i = 0; i < core.size(); ++i) EXPECT_LT(length(core[i] - back[core.size() - 1 - i]), 1e-12);
}

TEST(Core, DoubledParticlesChangeNothing) {
  const Strand strand = cut(Helix{}, 65);
  Strand doubled;
  for (Vec3d p : strand) doubled.insert(doubled.end(), 2, p);
  const std::vector<double> at = arcPositions(strand), doubledAt = arcPositions(doubled);
  const std::vector<Vec3d> core = smoothCore(strand, at, at.back() / 8);
  const std::vector<Vec3d> doubledCore = smoothCore(doubled, doubledAt, at.back() / 8);
  for (std::size_t i = 0; i < core.size(); ++i) {
    EXPECT_LT(length(core[i] - doubledCore[2 * i]), 1e-12);
    EXPECT_LT(length(core[i] - doubledCore[2 * i + 1]), 1e-12);
  }
}

TEST(FramesAlong, FollowWithoutTwist) {
  // Along a flat arc the normal across its plane stays; the frame's tangent is the core's.
  std::vector<Vec3d> arc;
  for (int i = 0; i <= 100; ++i) arc.push_back({std::cos(0.03 * i), std::sin(0.03 * i), 0});
  const MeasuringFrame root{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}};
  for (const MeasuringFrame& frame : framesAlong(arc, root)) {
    EXPECT_NEAR(frame.normal.z, 1, 1e-12);
    EXPECT_NEAR(length(cross(frame.normal, frame.binormal) - frame.tangent), 0, 1e-12);
  }
}

TEST(FramesAlong, SurviveACoreWithoutLength) {
  const std::vector<Vec3d> core(5, Vec3d{1, 2, 3});
  for (const MeasuringFrame& frame : framesAlong(core, rootFrameOf(core))) {
    EXPECT_NEAR(length(frame.normal), 1, 1e-12);
    EXPECT_NEAR(dot(frame.normal, frame.tangent), 0, 1e-12);
  }
  // And one that folds back on itself.
  const std::vector<Vec3d> folded{{0, 0, 0}, {0, -1, 0}, {0, -2, 0}, {0, -1, 0}, {0, 0, 0}};
  for (const MeasuringFrame& frame : framesAlong(folded, rootFrameOf(folded)))
    EXPECT_NEAR(length(frame.normal), 1, 1e-12);
}

}  // namespace
}  // namespace ringlet::core_test
