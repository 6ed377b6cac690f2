// measure/frame_turn.h against strands whose frames are known.
#include "ringlet/measure/frame_turn.h"

#include <gtest/gtest.h>

#include "tests/measure/strand_samples.h"

namespace ringlet::frame_turn_test {
namespace {

using namespace test;

// Three edges of 1 cm: down, back up but for a small tilt, down. The tilt goes to `azimuth` about the strand.
Strand folded(double tilt, double azimuth) {
  const Vec3d back{std::sin(tilt) * std::cos(azimuth), std::cos(tilt), std::sin(tilt) * std::sin(azimuth)};
  const Vec3d down{0, -1, 0};
  Strand strand{Vec3d{}};
  for (Vec3d edge : {down, back, down}) strand.push_back(strand.back() + edge * 0.01);
  return strand;
}

double turnBetween(const Groom& rest, const Strand& before, const Strand& after, double smoothingLength) {
  FrameTurn turn(rest, {.bendSmoothingLength = smoothingLength});
  turn.look(asFloats(before), 1);
  EXPECT_EQ(turn.largest(), 0);
  turn.look(asFloats(after), 1);
  return turn.largest();
}

// Half turns about two axes differ by twice the angle between the axes: where the strand folds flat, its raw
// frame turns twice as far as the fold does about the strand, however little the particles move.
TEST(FrameTurn, AFlatFoldTurnsTheRawFrameByTwiceItsAzimuth) {
  const Groom rest = groomOf({folded(0.01, 0)});
  for (double degrees : {10.0, 60.0, 90.0}) {
    const Strand after = folded(0.01, degrees * kPi / 180);
    EXPECT_NEAR(turnBetween(rest, folded(0.01, 0), after, 0), 2 * degrees, 1) << degrees;
    // The smoothed strand does not fold: it is tilted by less than the fold is, and turns by no more.
    EXPECT_LT(turnBetween(rest, folded(0.01, 0), after, 0.1), 0.01 * 180 / kPi) << degrees;
  }
}

TEST(FrameTurn, TheHeadCarriesTheFrames) {
  const Strand strand = cut({}, 64);
  const Quatd head = turnAbout({0.6, 0, 0.8}, 70);
  FrameTurn turn(groomOf({strand, moved(strand, {}, {0.1, 0, 0})}), {});
  turn.look(groomOf({strand, moved(strand, {}, {0.1, 0, 0})}).points, 1);
  const Strand carried = moved(strand, head, {3, -1, 2});
  turn.look(groomOf({carried, carried}).points, 1, head);
  EXPECT_LT(turn.largest(), 0.01);  // floats 3 m away: 2e-7 m of an edge of 1 cm, 1e-3 degrees an edge

  // One strand of several is enough.
  turn.look(groomOf({carried, moved(strand, {}, {0.1, 0, 0})}).points, 1, head);
  EXPECT_GT(turn.largest(), 10);
}

TEST(FrameTurn, DoesNotDependOnTheUnit) {
  const Strand before = cut({}, 32), after = cut({.radius = 0.012, .length = 0.2}, 32);
  const Groom metres = groomOf({before});
  Groom centimetres;
  std::vector<Vec3f> strand;
  for (Vec3d p : before) strand.push_back(Vec3f(p * 100.0));
  centimetres.addStrand(strand);

  FrameTurn one(metres, {}), other(centimetres, {});
  one.look(metres.points, 1);
  other.look(centimetres.points, 0.01);
  one.look(asFloats(after), 1);
  other.look(asFloats(after), 1);
  EXPECT_GT(one.largest(), 1);
  EXPECT_NEAR(one.largest(), other.largest(), 1e-3);
}

}  // namespace
}  // namespace ringlet::frame_turn_test
