// measure/strand_measure.h against strands whose numbers are known: helices of any cut, stretched, unwound,
// turned, and what is no curl.
#include "ringlet/measure/strand_measure.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "tests/measure/strand_samples.h"
#include "tests/support/tolerances.h"

namespace ringlet::strand_measure_test {
namespace {

using namespace test;

constexpr Vec3d kUp{0, 1, 0};

StrandRuler rulerOf(const Strand& rest) {
  auto ruler = StrandRuler::make(rest);
  EXPECT_TRUE(ruler) << ruler.error().message;
  return *ruler;
}

StrandMeasure measure(const Strand& rest, const Strand& now, Quatd head = {}) {
  auto measured = rulerOf(rest).measure(now, kUp, head);
  EXPECT_TRUE(measured) << measured.error().message;
  return *measured;
}

TEST(StrandMeasure, OfAHelixIsExactAtAnySampling) {
  for (double turns : {1.5, 2.0, 4.0, 8.0, 24.0, 60.0}) {
    for (int handedness : {1, -1}) {
      for (int count : {16, 32, 64, 128, 256}) {
        if (count / turns < 4) continue;
        SCOPED_TRACE(testing::Message() << turns << " turns, " << count << " particles, hand " << handedness);
        const Helix helix{.turns = turns, .handedness = handedness, .phase = 1};
        const Strand strand = moved(cut(helix, count), turnAbout({0.6, 0, 0.8}, 70), {3, -1, 2});
        const StrandMeasure rest = rulerOf(strand).rest();
        EXPECT_NEAR(rest.turns, turns, kSampling * turns);
        EXPECT_NEAR(rest.winding, handedness * turns, kSampling * turns);
        EXPECT_NEAR(rest.meanRadius, 0.01, kSampling * 0.01);
        EXPECT_NEAR(rest.coreLength, 0.25, kSampling * 0.25);
        EXPECT_EQ(rest.handedness, handedness);
        EXPECT_EQ(rest.handednessKept, 1);
        EXPECT_NEAR(rest.tipRotation, 0, 1e-9);
        EXPECT_EQ(rest.droop, 0);
        EXPECT_EQ(rest.arcDrift, 0);
        EXPECT_EQ(rest.maxEdgeStretch, 1);
        EXPECT_EQ(rest.coreElongation, 1);
        EXPECT_EQ(rest.chordElongation, 1);
      }
    }
  }
}

TEST(StrandMeasure, AStretchedHelixElongatesByTheSame) {
  for (int count : {32, 64, 256}) {
    // A fifth longer, a tenth thinner, half a turn unwound: all three come back.
    const Helix rest{}, now{.radius = 0.009, .turns = 7.5, .length = 0.3};
    const StrandMeasure measured = measure(cut(rest, count), cut(now, count));
    SCOPED_TRACE(testing::Message() << count << " particles");
    EXPECT_NEAR(measured.coreElongation, 1.2, kSampling);
    EXPECT_NEAR(measured.coreLength, 0.3, kSampling * 0.3);
    EXPECT_NEAR(measured.meanRadius, 0.009, kSampling * 0.009);
    EXPECT_NEAR(measured.turns, 7.5, kSampling * 7.5);
    EXPECT_EQ(measured.handednessKept, 1);

    // The tip: 0.05 m lower; its chord and the polyline by their own formulas.
    EXPECT_NEAR(measured.droop, 0.05, 1e-12);
    const double arc = std::hypot(2 * kPi * 0.01 * 8, 0.25);
    EXPECT_NEAR(measured.relativeDroop, 0.05 / arc, kSampling * 0.05 / arc);
    EXPECT_NEAR(measured.chordElongation, std::hypot(0.3, 2 * 0.009) / 0.25, 1e-12);
    auto edge = [&](const Helix& helix) {
      return std::hypot(helix.length / (count - 1),
                        2 * helix.radius * std::sin(kPi * helix.turns / (count - 1)));
    };
    EXPECT_NEAR(measured.arcDrift, edge(now) / edge(rest) - 1, 1e-12);
    EXPECT_NEAR(measured.maxEdgeStretch, edge(now) / edge(rest), 1e-12);
  }
}

TEST(StrandMeasure, ACurlPulledStraightHasNoTurnsLeft) {
  const Helix rest{};
  const StrandMeasure measured = measure(cut(rest, 64), cut({.radius = 0, .length = 0.55}, 64));
  EXPECT_EQ(measured.turns, 0);
  EXPECT_EQ(measured.handedness, 0);
  EXPECT_EQ(measured.handednessKept, 0);
  EXPECT_NEAR(measured.meanRadius, 0, 1e-12);
  EXPECT_NEAR(measured.coreElongation, 0.55 / 0.25, 1e-3);
}

TEST(StrandMeasure, AMirroredCurlHasLostItsHand) {
  const StrandMeasure measured = measure(cut({}, 64), cut({.handedness = -1}, 64));
  EXPECT_NEAR(measured.turns, -8, 0.01) << "counted against what they were";
  EXPECT_EQ(measured.handedness, -1);
  EXPECT_EQ(measured.handednessKept, 0);
}

TEST(StrandMeasure, ALongestEdgeIsFound) {
  Strand now = cut({}, 64);
  for (std::size_t i = 40; i < now.size(); ++i) now[i] = now[i] + (now[40] - now[39]) * 0.07;
  const Strand rest = cut({}, 64);
  for (std::size_t i = 40; i < now.size(); ++i) now[i] = rest[i] + (rest[40] - rest[39]) * 0.07;
  EXPECT_NEAR(measure(rest, now).maxEdgeStretch, 1.07, 1e-12);
}

TEST(StrandMeasure, DroopIsAlongUpAndFromTheRoot) {
  const Strand rest = cut({}, 64);
  auto ruler = rulerOf(rest);
  Strand now = moved(rest, {}, {5, 6, 7});
  now.back() += Vec3d{0.001, -0.002, -0.003};
  EXPECT_NEAR(ruler.measure(now, {0, 1, 0})->droop, 0.002, 1e-12);
  EXPECT_NEAR(ruler.measure(now, {0, 0, 1})->droop, 0.003, 1e-12);
}

TEST(TipRotation, IsTheAngleTheStrandWasTurnedAboutItsCore) {
  for (int count : {32, 64, 256}) {
    for (double angle : {-170.0, -90.0, -5.0, 0.0, 1.0, 45.0, 179.0}) {
      // About -Y, the way from root to tip; the head did not turn.
      const Strand rest = cut({}, count);
      const StrandMeasure measured = measure(rest, moved(rest, turnAbout({0, -1, 0}, angle)));
      EXPECT_NEAR(measured.tipRotation, angle, 0.1) << count << " particles";
      EXPECT_NEAR(measured.turns, 8, 0.08);
    }
  }
}

TEST(TipRotation, OfARigidHeadTurnIsNothing) {
  const Strand rest = cut({.turns = 6.3}, 48);
  for (Vec3d axis : {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0.48, 0.6, 0.64}}) {
    for (double angle : {10.0, 100.0, 180.0, 250.0}) {
      const Quatd head = turnAbout(axis, angle);
      const StrandMeasure measured = measure(rest, moved(rest, head, {1, 2, 3}), head);
      EXPECT_NEAR(measured.tipRotation, 0, 1e-6);
      EXPECT_NEAR(measured.droop, 0, 1e-12);
      EXPECT_NEAR(measured.coreElongation, 1, 1e-12);
      EXPECT_NEAR(measured.turns, rulerOf(rest).rest().turns, 1e-9);
    }
  }
}

TEST(TipRotation, FollowsAHeadThatBendsTheCurl) {
  // Turned about a horizontal axis without the head, the curl swings as a pendulum does: no twist about the
  // core.
  const Strand rest = cut({}, 64);
  EXPECT_NEAR(measure(rest, moved(rest, turnAbout({1, 0, 0}, 60))).tipRotation, 0, 0.1);
  EXPECT_NEAR(measure(rest, moved(rest, turnAbout({0.6, 0, 0.8}, -100))).tipRotation, 0, 0.1);
}

TEST(TipRotation, OfAnUnwoundCurlIsWhatItsLastTurnLost) {
  // Half a turn lost evenly over 8: in the middle of the last turn, at 15/16 of the way, 15/16 of it.
  for (int count : {32, 64, 256}) {
    const StrandMeasure measured = measure(cut({}, count), cut({.turns = 7.75}, count));
    EXPECT_NEAR(measured.tipRotation, -90 * 15.0 / 16, 2) << count << " particles";
  }
}

TEST(TipRotation, Unwraps) {
  EXPECT_EQ(unwrapDegrees(170, 0), 170);
  EXPECT_EQ(unwrapDegrees(-170, 170), 190);
  EXPECT_EQ(unwrapDegrees(10, 730), 730);
  EXPECT_EQ(unwrapDegrees(10, -700), -710);
}

TEST(Perversion, KeepsItsTurnsThoughItsHalvesCancel) {
  for (int count : {48, 64, 128, 256}) {
    SCOPED_TRACE(testing::Message() << count << " particles");
    const Strand rest = perversion({.turns = 10}, count);
    const StrandMeasure measured = rulerOf(rest).rest();
    EXPECT_NEAR(measured.turns, 10, 0.5);
    EXPECT_NEAR(measured.winding, 0, 0.3);
    EXPECT_EQ(measured.handedness, 0);
    EXPECT_EQ(measured.handednessKept, 1);
    EXPECT_NEAR(measured.meanRadius, 0.01, 0.001);

    // Stretched it keeps them; wound one way all along, half of it has changed its hand.
    const StrandMeasure stretched = measure(rest, perversion({.turns = 10, .length = 0.3}, count));
    EXPECT_NEAR(stretched.turns, measured.turns, 0.1);
    EXPECT_EQ(stretched.handednessKept, 1);
    const StrandMeasure wound = measure(rest, cut({.turns = 10}, count));
    EXPECT_NEAR(wound.handednessKept, 0.5, 0.1);
    EXPECT_NEAR(wound.winding, 10, 0.1);
    EXPECT_NEAR(wound.turns, 0, 0.5) << "the second half counts against its own hand";
  }
}

TEST(StraightStrand, HasNoCurlNumbers) {
  const Strand rest = cut({.radius = 0}, 33);
  StrandMeasure measured = rulerOf(rest).rest();
  EXPECT_EQ(measured.turns, 0);
  EXPECT_EQ(measured.winding, 0);
  EXPECT_EQ(measured.handedness, 0);
  EXPECT_EQ(measured.handednessKept, 1);
  EXPECT_EQ(measured.tipRotation, 0);
  EXPECT_NEAR(measured.meanRadius, 0, 1e-12);
  EXPECT_NEAR(measured.coreLength, 0.25, 1e-12);

  // Bent to a quarter of a circle of the same length: the tip is 1 - 2/pi of it above where it was.
  Strand now;
  for (int i = 0; i < 33; ++i) {
    const double angle = kPi / 2 * i / 32;
    now.push_back({0.25 * 2 / kPi * (1 - std::cos(angle)), -0.25 * 2 / kPi * std::sin(angle), 0});
  }
  measured = measure(rest, now);
  EXPECT_NEAR(measured.relativeDroop, -(1 - 2 / kPi), 1e-3);
  EXPECT_NEAR(measured.chordElongation, std::sqrt(2) * 2 / kPi, 1e-12);
  EXPECT_NEAR(measured.coreElongation, 1, 0.01);
  EXPECT_NEAR(measured.arcDrift, 0, 1e-3);
}

TEST(StraightStrand, StaysStraightUnderNoise) {
  // Noise of any size on a line has no turns; by chance one strand in a thousand winds.
  std::mt19937 random(3);
  int curled = 0;
  for (double size : {1e-6, 1e-4, 1e-3, 1e-2}) {
    std::uniform_real_distribution<double> noise(-size, size);
    for (int count : {16, 33, 64, 128}) {
      for (int i = 0; i < 50; ++i) {
        Strand rest = cut({.radius = 0}, count);
        for (Vec3d& p : rest) p += Vec3d{noise(random), noise(random), noise(random)};
        if (rulerOf(rest).rest().turns != 0) ++curled;
      }
    }
  }
  EXPECT_LE(curled, 2) << "of 800";
}

TEST(StrandMeasureOfBrokenInput, IsAnErrorOrSane) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN(),
                   kInfinity = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(StrandRuler::make(Strand{}));
  EXPECT_FALSE(StrandRuler::make(Strand{{1, 2, 3}}));
  EXPECT_FALSE(StrandRuler::make(Strand(10, Vec3d{1, 2, 3}))) << "no length";
  Strand broken = cut({}, 32);
  broken[7].z = kNan;
  auto refused = StrandRuler::make(broken);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("particle 7"), std::string::npos) << refused.error().message;
  broken[7].z = kInfinity;
  EXPECT_FALSE(StrandRuler::make(broken));
  auto now = rulerOf(cut({}, 32)).measure(broken, kUp);
  ASSERT_FALSE(now);
  EXPECT_NE(now.error().message.find("particle 7"), std::string::npos) << now.error().message;

  // Two particles are a straight strand.
  const StrandMeasure two = measure({{0, 0, 0}, {0, -1, 0}}, {{0, 0, 0}, {0, -1.1, 0}});
  EXPECT_NEAR(two.droop, 0.1, 1e-12);
  EXPECT_NEAR(two.coreElongation, 1.1, 1e-12);
  EXPECT_NEAR(two.maxEdgeStretch, 1.1, 1e-12);
  EXPECT_EQ(two.turns, 0);

  // Edges of no length, at rest or now, change nothing and divide nothing.
  Strand doubled;
  for (Vec3d p : cut({}, 64)) doubled.insert(doubled.end(), 2, p);
  const StrandMeasure rest = rulerOf(doubled).rest();
  EXPECT_NEAR(rest.turns, 8, 0.01);
  EXPECT_NEAR(rest.meanRadius, 0.01, 1e-4);
  EXPECT_EQ(rest.maxEdgeStretch, 1);
  const StrandMeasure collapsed = measure(cut({}, 64), Strand(64, Vec3d{1, 1, 1}));
  EXPECT_EQ(collapsed.turns, 0);
  EXPECT_NEAR(collapsed.coreElongation, 0, 1e-12);
  EXPECT_EQ(collapsed.maxEdgeStretch, 0);
  EXPECT_EQ(collapsed.arcDrift, -1);

  // A flat ring, walked twice, has a core without length.
  Strand ring;
  for (int i = 0; i < 65; ++i)
    ring.push_back({0.01 * std::cos(kPi * i / 16), 0, 0.01 * std::sin(kPi * i / 16)});
  const StrandMeasure flat = rulerOf(ring).rest();
  EXPECT_EQ(flat.coreElongation, 1);
  EXPECT_TRUE(std::isfinite(flat.turns) && std::isfinite(flat.meanRadius));
}

}  // namespace
}  // namespace ringlet::strand_measure_test
