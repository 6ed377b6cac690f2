// groom/curl_shape.h against helices whose shape is known, against what is no curl, and on real coils.
#include "ringlet/groom/curl_shape.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "ringlet/groom/groom_file.h"
#include "tests/support/test_support.h"

namespace ringlet::curl_shape_test {
namespace {

using Strand = std::vector<Vec3d>;
constexpr double kPi = std::numbers::pi;

struct Helix {
  double radius = 0.01, turns = 8, length = 0.25;
  int handedness = 1;
};

Vec3d pointOn(const Helix& helix, double s) {
  const double angle = 2 * kPi * helix.turns * s;
  // Right-handed: seen along the way it goes, it turns clockwise; here from X to Y while going to Z.
  return {helix.radius * std::cos(angle), helix.handedness * helix.radius * std::sin(angle),
          helix.length * s};
}

Strand cut(const Helix& helix, int count) {
  Strand strand;
  for (int i = 0; i < count; ++i) strand.push_back(pointOn(helix, double(i) / (count - 1)));
  return strand;
}

// Noise of equal size in all directions, unlike anything a groomer makes.
void shake(Strand& strand, double size, std::uint32_t seed) {
  std::mt19937 random(seed);
  auto number = [&] { return (double(random()) / 4294967295.0 - 0.5) * 2 * size; };
  for (Vec3d& p : strand) {
    const double x = number(), y = number(), z = number();
    p += {x, y, z};
  }
}

Strand turned(Strand strand) {
  const Quatd turn = fromRotationVector(Vec3d{0.7, -1.9, 0.4});
  for (Vec3d& p : strand) p = rotate(turn, p) + Vec3d{3, -5, 11};
  return strand;
}

void expectStraight(const Strand& strand, const std::string& what) {
  const CurlShape shape = measureCurl(strand);
  EXPECT_EQ(shape.turns, 0) << what;
  EXPECT_EQ(shape.turnLength, 0) << what;
  EXPECT_EQ(shape.radius, 0) << what;
  EXPECT_EQ(shape.pitch, 0) << what;
  EXPECT_EQ(shape.handedness, 0) << what;
}

TEST(CurlShape, MeasuresAHelixExactlyHoweverCoarseEitherHandAnyPose) {
  for (double turns : {1.5, 2.0, 8.0, 24.0}) {
    for (int handedness : {1, -1}) {
      for (int count : {32, 63, 128, 256}) {
        if (count / turns < 3) continue;
        const Helix helix{.turns = turns, .handedness = handedness};
        const CurlShape shape = measureCurl(turned(cut(helix, count)));
        SCOPED_TRACE(testing::Message() << turns << " turns, " << count << " particles, hand " << handedness);
        EXPECT_NEAR(shape.turns, turns, 1e-9 * turns);
        EXPECT_NEAR(shape.radius, 0.01, 1e-11);
        EXPECT_NEAR(shape.pitch, 0.25 / turns, 1e-11);
        EXPECT_EQ(shape.handedness, handedness);
        // The true arc of a turn; each edge's arc is estimated, worst where edges turn most.
        const double perTurn = std::hypot(2 * kPi * 0.01, 0.25 / turns);
        EXPECT_NEAR(shape.turnLength, perTurn, (count / turns >= 8 ? 0.002 : 0.03) * perTurn);
      }
    }
  }
}

TEST(CurlShape, UnevenCutsChangeLittle) {
  Strand strand;
  const Helix helix;
  for (int i = 0; i < 65; ++i) strand.push_back(pointOn(helix, (i + 0.4 * std::sin(1.7 * i)) / 64));
  const CurlShape shape = measureCurl(strand);
  EXPECT_NEAR(shape.turns, 8, 0.08);
  EXPECT_NEAR(shape.radius, 0.01, 1e-4);
  EXPECT_NEAR(shape.pitch, 0.25 / 8, 0.03 * 0.25 / 8);
}

TEST(CurlShape, NoiseOnACurlChangesLittle) {
  Strand strand = cut(Helix{.handedness = -1}, 64);
  shake(strand, 3e-4, 1);
  const CurlShape shape = measureCurl(strand);
  EXPECT_NEAR(shape.turns, 8, 0.1);
  EXPECT_NEAR(shape.radius, 0.01, 2e-4);
  EXPECT_EQ(shape.handedness, -1);
}

TEST(CurlShape, AStraightRootDoesNotWidenTheRinglet) {
  Strand strand;
  for (int i = 0; i < 64; ++i) strand.push_back({0.01, 0, -0.2 + 0.2 * i / 64});
  for (const Vec3d& p : cut(Helix{}, 64)) strand.push_back(p);
  const CurlShape shape = measureCurl(strand);
  EXPECT_NEAR(shape.turns, 8, 0.4);
  EXPECT_NEAR(shape.radius, 0.01, 6e-4);
  EXPECT_NEAR(shape.turnLength, std::hypot(2 * kPi * 0.01, 0.25 / 8), 0.004);
}

// Helices one after another along Z, an equal share of the particles each. From one to the next the curl's
// rate changes over half a turn, so that the strand has no kink: where the hand changes, a perversion as in
// real hair.
Strand joined(const std::vector<Helix>& parts, int count) {
  const int steps = count / static_cast<int>(parts.size());
  auto rate = [&](std::size_t part) { return parts[part].handedness * 2 * kPi * parts[part].turns / steps; };
  Strand strand{{0.01, 0, 0}};
  double angle = 0, height = 0;
  for (std::size_t part = 0; part < parts.size(); ++part) {
    const double half = 0.25 * steps / std::max(parts[part].turns, 1.0);  // of the change, in particles
    for (int i = 0; i < steps; ++i) {
      double share = 0;
      std::size_t other = part;
      if (part > 0 && i < half) other = part - 1, share = 0.5 - 0.5 * (i + 0.5) / half;
      if (part + 1 < parts.size() && steps - i <= half) {
        other = part + 1, share = 0.5 - 0.5 * (steps - i - 0.5) / half;
      }
      angle += rate(part) + share * (rate(other) - rate(part));
      height += parts[part].length / steps;
      strand.push_back({0.01 * std::cos(angle), 0.01 * std::sin(angle), height});
    }
  }
  return strand;
}

TEST(CurlShape, PerversionsDoNotFlattenACurl) {
  // However coarse: 4 particles a turn is what real tight coils have, and there the halves used to cancel.
  for (int count : {40, 80, 160, 320}) {
    SCOPED_TRACE(testing::Message() << count << " particles");
    const Helix right{.turns = 5, .length = 0.125}, left{.turns = 5, .length = 0.125, .handedness = -1};
    const CurlShape half = measureCurl(turned(joined({right, left}, count)));
    EXPECT_NEAR(half.turns, 10, 0.5);
    EXPECT_NEAR(half.radius, 0.01, 0.0005);
    EXPECT_NEAR(half.pitch, 0.025, 0.0025);
    EXPECT_EQ(half.handedness, 0);
    EXPECT_EQ(half.perversions, 1);

    const CurlShape most = measureCurl(turned(joined({left, right, right, right}, 2 * count)));
    EXPECT_EQ(most.handedness, 1);
    EXPECT_EQ(most.perversions, 1);
    EXPECT_EQ(measureCurl(joined({right, left, right}, 3 * count / 2)).perversions, 2);
    EXPECT_EQ(measureCurl(joined({right, right}, count)).perversions, 0);
  }
}

TEST(CurlShape, StretchesFollowACurlThatVaries) {
  // Loose at the root, tight at the tip.
  const Helix loose{.turns = 4, .length = 0.2}, tight{.turns = 12, .length = 0.1};
  const Strand strand = joined({loose, tight}, 240);
  const std::vector<CurlStretch> stretches = measureCurlAlong(turned(strand)).stretches;
  ASSERT_GE(stretches.size(), 6u);
  EXPECT_NEAR(stretches.front().shape.turnLength, std::hypot(2 * kPi * 0.01, 0.05), 0.002);
  EXPECT_NEAR(stretches.front().shape.pitch, 0.05, 0.002);
  EXPECT_NEAR(stretches.back().shape.turnLength, std::hypot(2 * kPi * 0.01, 0.1 / 12), 0.002);
  EXPECT_NEAR(stretches.back().shape.pitch, 0.1 / 12, 0.001);
  double length = 0, turns = 0;
  for (const CurlStretch& stretch : stretches) length += stretch.length, turns += stretch.shape.turns;
  EXPECT_NEAR(turns, 16, 0.4);
  EXPECT_NEAR(length, std::hypot(8 * kPi * 0.01, 0.2) + std::hypot(24 * kPi * 0.01, 0.1), 0.02);
}

TEST(CurlShape, StretchesLeaveOutWhatIsStraight) {
  const Strand strand = joined({{.turns = 0, .length = 0.2}, {.turns = 6, .length = 0.15}}, 128);
  const std::vector<CurlStretch> stretches = measureCurlAlong(strand).stretches;
  ASSERT_FALSE(stretches.empty());
  double length = 0;
  for (const CurlStretch& stretch : stretches) {
    length += stretch.length;
    EXPECT_EQ(stretch.shape.handedness, 1);
  }
  const double curled = std::hypot(12 * kPi * 0.01, 0.15);
  EXPECT_NEAR(length, curled, 0.2 * curled);  // to a stretch at the border

  // Exactly one helix: every stretch is it. A straight strand has none, a perversion is told of.
  for (const CurlStretch& stretch : measureCurlAlong(cut(Helix{}, 64)).stretches) {
    EXPECT_NEAR(stretch.shape.radius, 0.01, 1e-9);
    EXPECT_NEAR(stretch.shape.pitch, 0.25 / 8, 1e-9);
    EXPECT_EQ(stretch.shape.perversions, 0);
  }
  EXPECT_TRUE(measureCurlAlong(cut(Helix{.radius = 0}, 64)).stretches.empty());
  int perversions = 0;
  for (const CurlStretch& stretch :
       measureCurlAlong(
           joined({{.turns = 5, .length = 0.1}, {.turns = 5, .length = 0.1, .handedness = -1}}, 80))
           .stretches) {
    perversions += stretch.shape.perversions;
  }
  EXPECT_EQ(perversions, 1);
}

TEST(CurlShape, ScalesWithTheUnit) {
  const Helix helix;
  Strand large = cut(helix, 64);
  for (Vec3d& p : large) p = p * 1000.0;
  const CurlShape a = measureCurl(cut(helix, 64)), b = measureCurl(large);
  EXPECT_NEAR(b.radius, 1000 * a.radius, 1e-9);
  EXPECT_NEAR(b.turnLength, 1000 * a.turnLength, 1e-9);
  EXPECT_NEAR(b.turns, a.turns, 1e-9);
}

TEST(CurlShape, FlatCurves) {
  // An arc of less than a turn is no curl, a ring walked almost twice is one without pitch.
  auto ring = [](int count) {
    Strand strand;
    for (int i = 0; i < count; ++i) strand.push_back({std::cos(0.12 * i), std::sin(0.12 * i), 0});
    return strand;
  };
  expectStraight(ring(40), "arc of 0.75 turns");
  const CurlShape shape = measureCurl(ring(100));
  EXPECT_NEAR(shape.turns, 99 * 0.12 / (2 * kPi), 1e-9);
  EXPECT_NEAR(shape.radius, 1, 1e-9);
  EXPECT_NEAR(shape.pitch, 0, 1e-9);
  EXPECT_NEAR(shape.turnLength, 2 * kPi, 1e-9);

  // A wave bends one way as much as the other; a zigzag has two particles a turn.
  for (double height : {0.3, 1.0, 3.0}) {
    Strand wave;
    for (int i = 0; i < 200; ++i) wave.push_back({0.12 * i, height * std::sin(0.12 * i), 0});
    expectStraight(wave, "flat wave");
  }
  Strand zigzag;
  for (int i = 0; i < 100; ++i) zigzag.push_back({double(i), double(i % 2), 0});
  expectStraight(zigzag, "zigzag");
}

TEST(CurlShape, NoiseOnALineIsNoCurl) {
  for (double size : {0.0, 1e-7, 1e-3, 0.03, 0.1, 0.3, 1.0}) {
    for (std::uint32_t seed = 0; seed < 50; ++seed) {
      Strand strand;
      for (int i = 0; i < 64; ++i) strand.push_back({double(i), 0, 0});
      shake(strand, size, seed);
      expectStraight(strand, "noise " + std::to_string(size) + ", seed " + std::to_string(seed));
    }
  }
}

TEST(CurlShape, AShallowCurlIsStraight) {
  // 2 pi r against a tenth of the pitch.
  const double limit = 0.1 * (0.25 / 4) / (2 * kPi);
  expectStraight(cut(Helix{.radius = 0.98 * limit, .turns = 4}, 128), "just too shallow");
  EXPECT_GT(measureCurl(cut(Helix{.radius = 1.02 * limit, .turns = 4}, 128)).turns, 3.9);
  expectStraight(cut(Helix{.turns = 0.98}, 128), "just too few turns");
  EXPECT_GT(measureCurl(cut(Helix{.turns = 1.02}, 128)).turns, 1);
}

TEST(CurlShape, SurvivesDegenerateStrands) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN(),
                   kInfinity = std::numeric_limits<double>::infinity();
  const Strand helix = cut(Helix{}, 32);
  for (int count = 0; count < 4; ++count) {
    expectStraight(Strand(helix.begin(), helix.begin() + count), "too few points");
  }
  expectStraight(Strand(10, Vec3d{1, 2, 3}), "all in one place");
  expectStraight(Strand(10, Vec3d{kNan, 0, 0}), "not numbers");
  expectStraight(Strand(10, Vec3d{kInfinity, 0, 0}), "not finite");

  // Doubled points and one that is no number leave a curl a curl.
  Strand doubled;
  for (const Vec3d& p : cut(Helix{}, 64)) doubled.insert(doubled.end(), 2, p);
  EXPECT_NEAR(measureCurl(doubled).turns, 8, 1e-9);
  EXPECT_NEAR(measureCurl(doubled).radius, 0.01, 1e-11);
  // So do edges so short that their direction is rounding: real files have them.
  Strand nearlyDoubled;
  for (const Vec3d& p : cut(Helix{}, 64)) {
    nearlyDoubled.push_back(p);
    nearlyDoubled.push_back(p + Vec3d{0, 0, -1e-6});
  }
  EXPECT_NEAR(measureCurl(nearlyDoubled).turns, 8, 0.01);
  EXPECT_NEAR(measureCurl(nearlyDoubled).radius, 0.01, 1e-5);
  Strand broken = cut(Helix{}, 128);
  broken[60].y = kNan;
  EXPECT_NEAR(measureCurl(broken).turns, 8, 0.2);
}

TEST(MeasureArcs, AreExactOnACircleAndChordsOnALine) {
  Strand strand;
  for (int i = 0; i < 9; ++i) strand.push_back({2 * std::cos(0.7 * i), 2 * std::sin(0.7 * i), 1});
  std::vector<double> arcs(8);
  measureArcs(strand, arcs);
  for (double arc : arcs) EXPECT_NEAR(arc, 1.4, 1e-12);

  strand.clear();
  for (int i = 0; i < 9; ++i) strand.push_back({double(i * i), 0, 0});
  measureArcs(strand, arcs);
  for (std::size_t i = 0; i < 8; ++i) EXPECT_NEAR(arcs[i], 2.0 * double(i) + 1, 1e-12);
}

TEST(MeasureArcs, AHelixAddsUpToItsTrueLength) {
  const double exact = std::hypot(2 * kPi * 0.01 * 8, 0.25);
  for (auto [count, tolerance] : {std::pair{32, 0.01}, {64, 0.001}, {256, 1e-5}}) {
    std::vector<double> arcs(static_cast<std::size_t>(count) - 1);
    measureArcs(cut(Helix{}, count), arcs);
    double sum = 0;
    for (double arc : arcs) sum += arc;
    EXPECT_NEAR(sum, exact, tolerance * exact) << count << " particles";
  }
}

TEST(MeasureArcs, SurvivesDegenerateStrands) {
  std::vector<double> none;
  measureArcs(Strand{}, none);
  measureArcs(Strand{{1, 2, 3}}, none);
  std::vector<double> arcs(3);
  measureArcs(Strand{{0, 0, 0}, {0, 0, 0}, {1, 0, 0}, {std::numeric_limits<double>::infinity(), 0, 0}}, arcs);
  EXPECT_EQ(arcs, (std::vector<double>{0, 1, 0}));
  // A hairpin turns by pi: half a circle over the chord.
  measureArcs(Strand{{0, 0, 0}, {1, 0, 0}, {0, 0, 0}, {1, 0, 0}}, arcs);
  for (double arc : arcs) EXPECT_NEAR(arc, kPi / 2, 1e-12);
}

TEST(CurlShapeOnRealHair, TightCoils) {
  for (const char* file : {"curlycue/frame_000.obj", "curlycue/frame_070_settled.obj"}) {
    RINGLET_NEEDS_DATA(path, file);
    const Result<LoadedGroom> loaded = readGroom(path);
    ASSERT_TRUE(loaded) << loaded.error().message;
    ASSERT_EQ(loaded->groom.strandCount(), 98u);
    std::vector<double> turns, radii;
    for (std::size_t s = 0; s < 98; ++s) {
      Strand strand;
      for (Vec3f p : loaded->groom.strand(s)) strand.push_back(Vec3d(p));
      const CurlShape shape = measureCurl(strand);
      turns.push_back(shape.turns);
      radii.push_back(shape.radius);
    }
    // About 24 turns of radius 0.54, says shared/data's README, measured by other means; none is straight.
    std::ranges::sort(turns);
    std::ranges::sort(radii);
    EXPECT_NEAR(turns[49], 24, 1) << file;
    EXPECT_NEAR(radii[49], 0.54, 0.03) << file;
    EXPECT_GT(turns.front(), 15) << file;
    EXPECT_LT(turns.back(), 33) << file;
    EXPECT_GT(radii.front(), 0.45) << file;
    EXPECT_LT(radii.back(), 0.65) << file;
  }
}

TEST(CurlShapeOnRealHair, StraightHair) {
  RINGLET_NEEDS_DATA(path, "hair/straight.hair");
  const Result<LoadedGroom> loaded = readGroom(path);
  ASSERT_TRUE(loaded) << loaded.error().message;
  for (std::size_t s = 0; s < loaded->groom.strandCount(); ++s) {
    Strand strand;
    for (Vec3f p : loaded->groom.strand(s)) strand.push_back(Vec3d(p));
    ASSERT_EQ(measureCurl(strand).turns, 0) << "strand " << s;
  }
}

}  // namespace
}  // namespace ringlet::curl_shape_test
