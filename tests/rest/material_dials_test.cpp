// Dials by formula.
#include "ringlet/rest/material_dials.h"

#include <gtest/gtest.h>

#include "ringlet/rest/material_parameters.h"
#include "ringlet/rest/material_presets.h"

namespace ringlet::material_dials_test {
namespace {

TEST(Dials, AtTheirDefaultsChangeNothing) {
  for (const std::string& name : presetNames()) {
    const Material before = materialPreset(name).value();
    Material material = before;
    EXPECT_FALSE(applyDials({}, material)) << name;
    EXPECT_EQ(material, before) << name;
  }
  EXPECT_EQ(dialsText({}), "");
}

// One by one, so that none acts on what is another's.
TEST(Dials, AreFactors) {
  const auto turned = [](const MaterialDials& dials) {
    Material material;
    EXPECT_FALSE(applyDials(dials, material)) << dialsText(dials);
    return material;
  };
  const Material before;
  Material expected = before;
  expected.bendStiffness *= 4;
  expected.bendDampingRatio *= 3;
  expected.bendDampingRatio /= 2;
  expected.coreDampingRatio *= 3;
  EXPECT_EQ(turned({.hold = 4, .springBack = 3}), expected);

  expected = before;
  expected.coreStiffness *= 0.25;
  EXPECT_EQ(turned({.curlKeep = 0.25}), expected);
  expected = before;
  expected.inertiaFactor = 2;
  EXPECT_EQ(turned({.bounce = 2}), expected);
  expected = before;
  expected.gravityFactor = 0.5;
  EXPECT_EQ(turned({.weight = 0.5}), expected);
  expected = before;
  expected.bendStiffness *= 0.4;
  expected.coreStiffness *= 0.4;
  expected.bendDampingRatio *= 2;
  expected.coreDampingRatio *= 2;
  expected.gravityFactor = 1.5;
  EXPECT_EQ(turned({.wet = 1}), expected);
  EXPECT_EQ(dialsText({.hold = 2, .wet = 0.5}), "hold 2, wet 0.5");
}

TEST(Dials, HoldOfRootAndTipFadesToTheMiddle) {
  Material material;
  EXPECT_FALSE(applyDials({.rootHold = 3, .tipHold = 0.5}, material));
  const Profile& alone = material.bendStiffnessProfile;
  for (const auto& [s, factor] : {std::pair(0.0, 3.0), {0.25, 2.0}, {0.5, 1.0}, {0.75, 0.75}, {1.0, 0.5}})
    EXPECT_DOUBLE_EQ(alone.at(s), factor) << s;

  // On top of the material's own profile: their product, exact at the points of both.
  Material other;
  other.bendStiffnessProfile.points = {{0.2, 2}, {0.75, 4}};
  EXPECT_FALSE(applyDials({.rootHold = 3, .tipHold = 0.5}, other));
  const Profile own{{{0.2, 2}, {0.75, 4}}};
  for (const double s : {0.0, 0.2, 0.5, 0.75, 1.0})
    EXPECT_DOUBLE_EQ(other.bendStiffnessProfile.at(s), own.at(s) * alone.at(s)) << s;
  EXPECT_TRUE(checkMaterial(other));
}

TEST(Dials, BendDampingIsKeptWhereItCannotFeedOnItself) {
  Material material;
  const auto warning = applyDials({.springBack = 0.5}, material);
  ASSERT_TRUE(warning);
  EXPECT_EQ(
      *warning,
      "the dials ask for a bend damping ratio of 0.075, below 0.1, where bending can feed on itself: 0.1 "
      "is used");
  EXPECT_EQ(material.bendDampingRatio, kLeastBendDampingRatio);
  EXPECT_EQ(material.coreDampingRatio, 0.5 * Material{}.coreDampingRatio);

  // Exactly the least is fine.
  Material least;
  least.bendDampingRatio = 0.2;
  EXPECT_FALSE(applyDials({.springBack = 0.5}, least));
  EXPECT_EQ(least.bendDampingRatio, 0.1);

  // Who asked for less in the material keeps it, but dials lower it no further; raising works as ever.
  Material low;
  low.bendDampingRatio = 0.05;
  EXPECT_FALSE(applyDials({}, low));
  EXPECT_EQ(low.bendDampingRatio, 0.05);
  EXPECT_TRUE(applyDials({.springBack = 0.5}, low));
  EXPECT_EQ(low.bendDampingRatio, 0.05);
  EXPECT_FALSE(applyDials({.springBack = 4}, low));
  EXPECT_EQ(low.bendDampingRatio, 0.2);

  // Of firmness nobody is told: it asks for stiffness.
  Material firm;
  EXPECT_FALSE(applyDials({.hold = 100}, firm));
  EXPECT_EQ(firm.bendDampingRatio, kLeastBendDampingRatio);
  EXPECT_FALSE(applyDials({.hold = 100}, low = Material{.bendDampingRatio = 0.05}));
  EXPECT_EQ(low.bendDampingRatio, 0.05);
}

}  // namespace
}  // namespace ringlet::material_dials_test
