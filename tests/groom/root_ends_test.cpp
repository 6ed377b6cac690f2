// groom/root_ends.h: strands that run from tip to root are told by the head, whatever number of them; heads
// of every style have none.
#include "ringlet/groom/root_ends.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "ringlet/groom/generate.h"
#include "ringlet/groom/groom_file.h"
#include "ringlet/groom/hair_styles.h"
#include "ringlet/output/groom_writer.h"
#include "tests/groom/groom_samples.h"
#include "tests/groom/style_samples.h"
#include "tests/support/test_support.h"

namespace ringlet::root_ends_test {
namespace {

using test::contains;

// Hair of a ball of radius 9 units, `length` long: it lies on the ball, further out with every particle, and
// hangs from where that is widest.
Groom ballOfHair(std::size_t strands, double length) {
  Groom groom;
  for (std::size_t s = 0; s < strands; ++s) {
    const double up = 1 - (static_cast<double>(s) + 0.5) / static_cast<double>(strands);
    const double turn = static_cast<double>(s) * std::numbers::pi * (3 - std::sqrt(5.0));
    std::vector<Vec3f> strand;
    for (int i = 0; i < 12; ++i) {
      const double way = length * i / 11, from = 9 * std::acos(up), widest = 9 * std::numbers::pi / 2;
      const double angle = std::min(from + way, widest) / 9, radius = 9 + 0.25 * i;
      const double below = std::max(from + way - widest, 0.0);
      strand.push_back(
          Vec3f(Vec3d{radius * std::sin(angle) * std::cos(turn), radius * std::cos(angle) - below,
                      radius * std::sin(angle) * std::sin(turn)}));
    }
    groom.addStrand(strand);
  }
  return groom;
}

std::vector<bool> every(std::size_t step, std::size_t count) {
  std::vector<bool> which(count);
  for (std::size_t s = 0; s < count; s += step) which[s] = true;
  return which;
}

TEST(RootEnds, AllOrSomeThatRunFromTipToRootAreFound) {
  for (const std::size_t strands : {20u, 60u, 500u}) {
    for (const double length : {6.0, 20.0, 60.0}) {
      const Groom good = ballOfHair(strands, length);
      const RootEnds none = findRootEnds(good);
      ASSERT_TRUE(none.head);
      EXPECT_NEAR(none.head->radius, 9, 0.2);
      EXPECT_EQ(std::ranges::count(none.isReversed, true), 0) << strands << " " << length;
      for (const std::size_t step : {1u, 2u, 3u, 7u}) {
        Groom turned = good;
        turnRound(every(step, strands), turned);
        const RootEnds found = findRootEnds(turned);
        EXPECT_EQ(found.isReversed, every(step, strands)) << strands << " " << length << " " << step;
        turnRound(found.isReversed, turned);
        EXPECT_TRUE(test::hasSameBits(turned, good));
      }
    }
  }
}

TEST(RootEnds, AHeadOfEveryStyleHasNoneTurnedAndAllOnceItIs) {
  for (const std::string& style : test::styleNames()) {
    const auto parameters = headOfStyle(style);
    ASSERT_TRUE(parameters) << style;
    auto head = makeHead(*parameters);
    ASSERT_TRUE(head) << style;
    const RootEnds good = findRootEnds(*head);
    EXPECT_EQ(std::ranges::count(good.isReversed, true), 0) << style;
    for (const std::size_t step : {1u, 2u, 10u}) {
      Groom turned = *head;
      turnRound(every(step, head->strandCount()), turned);
      EXPECT_EQ(findRootEnds(turned).isReversed, every(step, head->strandCount())) << style << step;
    }
  }
}

// By hand: on what roots stand on up to 1, clear of it 2 further out.
TEST(RootEnds, OnlyAnEndThatIsClearOfTheHeadIsATip) {
  const std::vector<EndDistances> strands{{0, 9},     {9, 0},   {0.5, 0},    {2.9, 1}, {3.1, 1},
                                          {2.1, 0.2}, {0, 2.1}, {2.2, 0.19}, {9, 1},   {1, 1}};
  EXPECT_EQ(reversedBy(strands, 1, 2),
            (std::vector<bool>{false, true, false, false, true, false, false, true, true, false}));
  // Of none it is said where more than one of five strands has no end there.
  std::vector<EndDistances> others{{9, 0}, {9, 0}, {9, 0}, {9, 0}, {9, 1.1}};
  EXPECT_EQ(reversedBy(others, 1, 2), (std::vector<bool>{true, true, true, true, false}));
  others[3] = {9, 1.1};
  EXPECT_EQ(reversedBy(others, 1, 2), std::vector<bool>(5, false));
}

// Heads of people are no balls, and hair may grow on a small part of them: tips are then more even than
// roots.
TEST(RootEnds, AGoodHeadThatIsNoBallHasNoneTurned) {
  const Vec3d kShapes[] = {{1, 1, 1}, {0.82, 1, 1.06}, {0.75, 1.1, 0.95}, {1, 0.9, 1.15}};
  for (const std::string& style : test::styleNames()) {
    for (const int strands : {12, 40, 120}) {
      for (const bool isCap : {false, true}) {
        HeadParameters parameters = *headOfStyle(style);
        parameters.strandCount = strands;
        if (isCap) parameters.browElevation = 1.1, parameters.napeElevation = 0.6;
        const auto head = makeHead(parameters);
        ASSERT_TRUE(head) << style;
        for (const Vec3d& shape : kShapes) {
          Groom egg = *head;
          for (Vec3f& p : egg.points) p = Vec3f(Vec3d{p.x * shape.x, p.y * shape.y, p.z * shape.z});
          EXPECT_EQ(std::ranges::count(findRootEnds(egg).isReversed, true), 0)
              << style << " " << strands << " " << isCap << " " << shape.x;
        }
      }
    }
  }
}

TEST(RootEnds, OfEightStrandsAndMoreAnyThatAreTurnedAreFound) {
  for (const std::size_t strands : {8u, 12u, 19u, 33u}) {
    for (const double length : {6.0, 20.0}) {
      for (const std::size_t step : {2u, 3u, 5u}) {
        Groom turned = ballOfHair(strands, length);
        turnRound(every(step, strands), turned);
        EXPECT_EQ(findRootEnds(turned).isReversed, every(step, strands)) << strands << " " << length << step;
      }
    }
  }
}

// Not the origin that an exporter wrote there.
TEST(RootEnds, AStrandBeginsAtItsFirstParticleThatIsNoStray) {
  for (const bool isFirst : {true, false}) {
    Groom strays;
    const Groom good = ballOfHair(60, 20);
    for (std::size_t s = 0; s < good.strandCount(); ++s) {
      std::vector<Vec3f> strand(good.strand(s).begin(), good.strand(s).end());
      strand.insert(isFirst ? strand.begin() : strand.end(), 2, Vec3f{0, 0, 0});
      strays.addStrand(strand);
    }
    EXPECT_EQ(std::ranges::count(findRootEnds(strays).isReversed, true), 0) << isFirst;
    turnRound(every(1, 60), strays);
    EXPECT_EQ(std::ranges::count(findRootEnds(strays).isReversed, true), 60) << isFirst;
  }
}

TEST(RootEnds, WithoutAHeadNothingIsSaid) {
  const auto swatch = makeSwatch({});
  ASSERT_TRUE(swatch);
  EXPECT_EQ(std::ranges::count(findRootEnds(*swatch).isReversed, true), 0);
  const Groom few = ballOfHair(7, 20);
  EXPECT_FALSE(findRootEnds(few).head);
  EXPECT_TRUE(findRootEnds(Groom{}).isReversed.empty());
}

TEST(RootEnds, AFileIsReadFromTheEndThatIsAskedFor) {
  const auto folder = test::scratchFolder("root_ends");
  const Groom good = ballOfHair(60, 20);
  Groom all = good, some = good;
  turnRound(every(1, 60), all);
  turnRound(every(3, 60), some);
  for (const char* ending : {"obj", "hair", "ply"}) {
    const std::string name = std::string("a.") + ending;
    const struct {
      const Groom* groom;
      RootEnd end;
      const char* says;
    } kCases[] = {{&good, RootEnd::first, ""},
                  {&good, RootEnd::head, ""},
                  {&all, RootEnd::last, "60 of 60 strands are turned round"},
                  {&all, RootEnd::head, "60 of 60 strands are turned round"},
                  {&some, RootEnd::head, "20 of 60 strands are turned round"}};
    for (const auto& one : kCases) {
      ASSERT_TRUE(writeGroom(folder / name, *one.groom));
      const auto loaded = readGroom(folder / name, {.rootEnd = one.end});
      ASSERT_TRUE(loaded) << loaded.error().message;
      EXPECT_TRUE(test::hasSameBits(loaded->groom, good)) << name << one.says;
      ASSERT_EQ(loaded->warnings.size(), *one.says ? 1u : 0u) << name;
      if (*one.says) {
        EXPECT_TRUE(contains(loaded->warnings[0], one.says)) << loaded->warnings[0];
      }
    }
  }
  // Where no head is found, nothing is turned, and that is said.
  const auto swatch = makeSwatch({});
  ASSERT_TRUE(swatch && writeGroom(folder / "swatch.hair", *swatch));
  const auto kept = readGroom(folder / "swatch.hair", {.rootEnd = RootEnd::head});
  ASSERT_TRUE(kept);
  EXPECT_TRUE(test::hasSameBits(kept->groom, *swatch));
  ASSERT_EQ(kept->warnings.size(), 1u);
  EXPECT_TRUE(contains(kept->warnings[0], "no ends on a ball")) << kept->warnings[0];
}

}  // namespace
}  // namespace ringlet::root_ends_test
