// measure/groom_inspection.h: sizes, units, the axis hair hangs along, and each fault by itself.
#include "ringlet/measure/groom_inspection.h"

#include <gtest/gtest.h>

#include <vector>

#include "ringlet/groom/generate.h"

namespace ringlet::groom_inspection_test {
namespace {

// Strands of eleven particles, `spacing` apart, each along `way` [unit].
Groom hanging(std::size_t strandCount, Vec3f way, float spacing = 0.1f) {
  Groom groom;
  for (std::size_t s = 0; s < strandCount; ++s) {
    std::vector<Vec3f> strand;
    for (int i = 0; i <= 10; ++i) strand.push_back(Vec3f{spacing * float(s), 0, 0} + way * (float(i) / 10));
    groom.addStrand(strand);
  }
  return groom;
}

std::string unitsOf(const GroomInspection& found) {
  std::string names;
  for (const LikelyUnit& unit : found.units) names += std::string(unit.name) + " ";
  return names;
}

TEST(GroomInspection, MeasuresStrands) {
  Groom groom = hanging(3, {0, -20, 0});
  groom.addStrand(std::vector<Vec3f>{{0, 0, 5}, {0, -3, 5}, {4, -3, 5}});
  const GroomInspection found = inspectGroom(groom);
  EXPECT_EQ(found.strandCount, 4u);
  EXPECT_EQ(found.particleCount, 36u);
  EXPECT_EQ(found.particles.min, 3);
  EXPECT_EQ(found.particles.max, 11);
  EXPECT_NEAR(found.length.min, 7, 1e-6);
  EXPECT_NEAR(found.length.median, 20, 1e-5);
  EXPECT_NEAR(found.length.mean, 67.0 / 4, 1e-5);
  EXPECT_NEAR(found.arcOverChord.max, 7.0 / 5, 1e-6);
  EXPECT_NEAR(found.arcOverChord.min, 1, 1e-6);
  EXPECT_EQ(found.box.low, (Vec3d{0, -20, 0}));
  EXPECT_EQ(found.box.high, (Vec3d{4, 0, 5}));
  EXPECT_EQ(found.curledCount, 0u);
  EXPECT_TRUE(found.isFaultless());
}

TEST(GroomInspection, ListsUnitsThatFitAHead) {
  EXPECT_EQ(unitsOf(inspectGroom(hanging(5, {0, -0.25f, 0}))), "m ");
  EXPECT_EQ(unitsOf(inspectGroom(hanging(5, {0, -25, 0}))), "cm inch ");
  EXPECT_EQ(unitsOf(inspectGroom(hanging(5, {0, -250, 0}))), "mm ");
  EXPECT_EQ(unitsOf(inspectGroom(hanging(5, {0, -35, 0}))), "cm mm inch ");
  EXPECT_EQ(unitsOf(inspectGroom(hanging(5, {0, -1e5f, 0}))), "");
}

TEST(GroomInspection, FindsTheAxisHairHangsAlong) {
  EXPECT_EQ(inspectGroom(hanging(5, {2, -20, 3})).likelyUp, 'Y');
  EXPECT_EQ(inspectGroom(hanging(5, {2, 3, -20})).likelyUp, 'Z');
  EXPECT_EQ(inspectGroom(hanging(5, {0, 20, 0})).likelyUp, 0);     // stands
  EXPECT_EQ(inspectGroom(hanging(5, {-20, 0, 0})).likelyUp, 0);    // no file has X up
  EXPECT_EQ(inspectGroom(hanging(5, {0, -20, -15})).likelyUp, 0);  // one could not tell
}

TEST(GroomInspection, FindsEachFaultByItself) {
  const auto with = [](const std::vector<Vec3f>& strand) {
    Groom groom = hanging(9, {0, -20, 0});
    groom.addStrand(strand);
    return inspectGroom(groom);
  };
  const auto expectOnly = [](const GroomInspection& found, GroomFault GroomInspection::*wanted,
                             std::size_t count) {
    for (auto fault : {&GroomInspection::repeatedParticles, &GroomInspection::shortEdges,
                       &GroomInspection::pointStrands, &GroomInspection::duplicates,
                       &GroomInspection::tooShort, &GroomInspection::tooLong, &GroomInspection::farAway}) {
      EXPECT_EQ((found.*fault).count, fault == wanted ? count : 0u);
    }
    EXPECT_EQ((found.*wanted).firstStrand, 9u);
    EXPECT_FALSE(found.isFaultless());
  };
  expectOnly(with({{0, 0, 1}, {0, -10, 1}, {0, -10, 1}, {0, -10, 1}, {0, -20, 1}}),
             &GroomInspection::repeatedParticles, 2);
  expectOnly(with({{0, 0, 1}, {0, -10, 1}, {0, -10.001f, 1}, {0, -20, 1}}), &GroomInspection::shortEdges, 1);
  expectOnly(with({{0, -5, 1}, {0, -5, 1}, {0, -5, 1}}), &GroomInspection::pointStrands, 1);
  const Groom same = hanging(9, {0, -20, 0});
  expectOnly(with({same.strand(4).begin(), same.strand(4).end()}), &GroomInspection::duplicates, 1);
  expectOnly(with({{0, -9, 1}, {0, -9.9f, 1}}), &GroomInspection::tooShort, 1);
  expectOnly(with({{0, 200, 1}, {0, -221, 1}}), &GroomInspection::tooLong, 1);
  expectOnly(with({{0, 0, 130}, {0, -20, 130}}), &GroomInspection::farAway, 1);
}

TEST(GroomInspection, AGeneratedHeadIsFaultless) {
  const auto head = makeHead({.strandCount = 200});
  ASSERT_TRUE(head);
  const GroomInspection found = inspectGroom(*head);
  EXPECT_TRUE(found.isFaultless());
  EXPECT_EQ(found.curledCount, 200u);
}

}  // namespace
}  // namespace ringlet::groom_inspection_test
