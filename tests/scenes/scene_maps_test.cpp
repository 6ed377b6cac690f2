// Factors on a material's numbers, strand by strand: what files and scenes say of them, and what becomes of a
// strand.
#include "ringlet/scenes/load/scene_maps.h"

#include <gtest/gtest.h>

#include <fstream>

#include "ringlet/rest/live_material.h"
#include "ringlet/rest/material_presets.h"
#include "ringlet/scenes/load/load_scene.h"
#include "tests/support/test_support.h"

namespace ringlet::scene_maps_test {
namespace {

const std::string kGroom = "[groom]\ngenerate = \"swatch\"\ncolumns = 3\nrows = 2\n";

Result<SceneFile> parsed(const std::string& text, const std::filesystem::path& folder = {}) {
  return parseScene(kGroom + text, "scene.toml", folder);
}

TEST(SceneMaps, StrandsAreRangesAndNumbers) {
  const auto runs = parseStrands("100:120, 7 ,0:6,1000000000:1000000000", 2.5);
  ASSERT_TRUE(runs) << runs.error().message;
  EXPECT_EQ(*runs, (std::vector<StrandRun>{
                       {0, 6, 2.5f}, {7, 7, 2.5f}, {100, 120, 2.5f}, {1000000000, 1000000000, 2.5f}}));
  const StrandFactors factors{&Material::bendStiffness, std::make_shared<std::vector<StrandRun>>(*runs)};
  for (const std::size_t in : {0, 3, 6, 7, 100, 120, 1000000000}) EXPECT_EQ(factors.of(in), 2.5) << in;
  for (const std::size_t out : {8, 99, 121, 999999999, 1000000001}) EXPECT_EQ(factors.of(out), 1) << out;
  for (const char* wrong :
       {"a", "1:", ":2", "3:1", "-1", "1.5", "1,,2", "1 2", "99999999999", "1000000001"}) {
    const auto refused = parseStrands(wrong, 1);
    ASSERT_FALSE(refused) << wrong;
    EXPECT_NE(refused.error().message.find("expected strands from 0 to 1000000000"), std::string::npos);
  }
  EXPECT_EQ(parseStrands("4:9,9", 1).error().message, "strand 9 is there twice");
}

TEST(SceneMaps, FilesHaveAStrandAndAFactorALine) {
  const auto runs = parseStrandFactors("strand,factor\r\n3, 0.5\n\n# none\n0,2 # the first\n1,1e-2");
  ASSERT_TRUE(runs) << runs.error().message;
  EXPECT_EQ(*runs, (std::vector<StrandRun>{{0, 0, 2}, {1, 1, 0.01f}, {3, 3, 0.5}}));
  EXPECT_TRUE(parseStrandFactors("")->empty());
  const struct {
    const char *text, *message;
  } kCases[] = {
      {"0,1\nstrand,factor",
       "line 2: found 'strand,factor'; expected a strand from 0 to 1000000000 and a factor from "
       "0.001 to 1000, as 12,0.5"},
      {"0", "line 1: found '0';"},
      {"0,0", "line 1: found '0,0';"},
      {"0,nan", "line 1: found '0,nan';"},
      {"0,2000", "line 1: found '0,2000';"},
      {"-1,1", "line 1: found '-1,1';"},
      {"1000000001,1", "line 1: found '1000000001,1';"},
      {"0,1,2", "line 1: found '0,1,2';"},
      {"5,1\n0,1\n5,2", "strand 5 is there twice"},
  };
  for (const auto& c : kCases) {
    const auto refused = parseStrandFactors(c.text);
    ASSERT_FALSE(refused) << c.text;
    EXPECT_EQ(refused.error().message.find(c.message), 0u) << refused.error().message;
  }
}

TEST(SceneMaps, MultiplyStrandByStrand) {
  const auto folder = test::scratchFolder("scene_maps");
  std::ofstream(folder / "soft.csv") << "1,0.5\n4,3\n";
  const auto scene = parsed(
      "[material]\nbend_stiffness = 8\n[material.dials]\nhold = 2\n[[map]]\nnumber = "
      "\"bend_stiffness\"\nfile = "
      "\"soft.csv\"\n[[map]]\nnumber = \"bend_stiffness\"\nstrands = \"0:1\"\nfactor = 10\n[[map]]\nnumber = "
      "\"core_stiffness\"\nstrands = \"5\"\nfactor = 0.25\n",
      folder);
  ASSERT_TRUE(scene) << scene.error().message;
  const auto loaded = loadScene(*scene);
  ASSERT_TRUE(loaded) << loaded.error().message;
  const double stiffness[] = {160, 80, 16, 16, 48, 16}, core = Material{}.coreStiffness;
  for (std::size_t s = 0; s < 6; ++s) {
    const Material own = materialOfStrand(loaded->material, s);
    EXPECT_DOUBLE_EQ(own.bendStiffness, stiffness[s]) << s;
    EXPECT_EQ(own.coreStiffness, s == 5 ? 0.25 * core : core) << s;
    EXPECT_TRUE(own.factors.empty());
  }
  Material other = loaded->material;
  other.factors.pop_back();
  EXPECT_EQ(fixedDifference(loaded->material, other), "map");
  EXPECT_EQ(fixedDifference(loaded->material, loadScene(*scene)->material), "")
      << "the same from another reading";

  const auto again = parseScene(sceneText(*scene, folder), "again", folder);
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(again->maps, scene->maps);
  EXPECT_EQ(again->material.material, scene->material.material);
}

TEST(SceneMaps, APresetForSomeStrands) {
  const auto scene =
      parsed("[material]\npreset = \"straight\"\n[[map]]\npreset = \"coil\"\nstrands = \"2:3\"\n");
  ASSERT_TRUE(scene) << scene.error().message;
  const Material straight = *materialPreset("straight"), coil = *materialPreset("coil");
  for (std::size_t s = 0; s < 6; ++s) {
    const Material own = materialOfStrand(scene->material.material, s);
    const Material& expected = s == 2 || s == 3 ? coil : straight;
    for (const Parameter<Material>& parameter : mappedParameters())
      EXPECT_NEAR(*parameter.of(own) / *parameter.of(expected), 1, 1e-6) << s << " " << parameter.key;
  }
}

TEST(SceneMaps, GroupsWhoseStrandsDoNotTouchAreBundles) {
  const std::string kGroups =
      "[[group]]\nname = \"bun\"\nstrands = \"0:1, 5\"\ntouch = false\n"
      "[[group]]\nname = \"rest\"\nstrands = \"2:4\"\n";
  const auto scene = parsed(kGroups + "[[group]]\nname = \"braid\"\nstrands = \"rest\"\ntouch = false\n");
  ASSERT_TRUE(scene) << scene.error().message;
  const auto loaded = loadScene(*scene);
  ASSERT_TRUE(loaded) << loaded.error().message;
  ASSERT_TRUE(loaded->settings.contacts.bundles);
  EXPECT_EQ(*loaded->settings.contacts.bundles, (std::vector<ContactBundle>{{0, 1, 5}, {2, 3, 4}}));
  EXPECT_EQ(parseScene(sceneText(*scene), "scene.toml")->groups, scene->groups);
  const auto plain = loadScene(*parsed("[[group]]\nname = \"all\"\nstrands = \"0:5\"\n"));
  EXPECT_FALSE(plain->settings.contacts.bundles);
  const struct {
    const char *text, *message;
  } kCases[] = {
      {"[[group]]\nname = \"braid\"\nstrands = \"4:5\"\ntouch = false\n",
       "strand 5 is in the groups bun and braid, and strands of neither touch each other; expected"},
      {"[[group]]\nname = \"braid\"\nstrands = \"6\"\ntouch = false\n",
       "the group braid names strand 6; the groom has 6, numbered from 0"},
  };
  for (const auto& c : kCases) {
    const auto wrong = loadScene(*parsed(kGroups + c.text));
    ASSERT_FALSE(wrong) << c.text;
    EXPECT_NE(wrong.error().message.find(c.message), std::string::npos) << wrong.error().message;
  }
}

TEST(SceneMaps, FactorsOnTheRadiusInContacts) {
  const std::string kMaps =
      "[contacts]\nradius = 0.003\n[[map]]\nnumber = \"contacts.radius\"\nstrands = \"1:2\"\nfactor = 2\n"
      "[[map]]\nnumber = \"contacts.radius\"\nstrands = \"2\"\nfactor = 0.25\n";
  const auto scene = parsed(kMaps);
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_FALSE(scene->hasMaterial);
  const auto loaded = loadScene(*scene);
  ASSERT_TRUE(loaded) << loaded.error().message;
  const ContactSettings& contacts = loaded->settings.contacts;
  ASSERT_TRUE(contacts.radiusFactors);
  EXPECT_EQ(*contacts.radiusFactors, (std::vector<float>{1, 2, 0.5, 1, 1, 1}));
  EXPECT_EQ(contacts.radiusFactor(6), 1);
  EXPECT_TRUE(loaded->material.factors.empty());
  EXPECT_FALSE(loadScene(*parsed("[contacts]\n"))->settings.contacts.radiusFactors);
  const auto wrong =
      loadScene(*parsed("[contacts]\n[[map]]\nnumber = \"contacts.radius\"\nstrands = \"6\"\nfactor = 2\n"));
  ASSERT_FALSE(wrong);
  EXPECT_EQ(wrong.error().message,
            "a map of contacts.radius names strand 6; the groom has 6, numbered from 0");
}

TEST(SceneMaps, FactorsOnTheWidth) {
  const auto scene = parsed("[[map]]\nnumber = \"output.width\"\nstrands = \"1, 4:5\"\nfactor = 3\n");
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_FALSE(scene->hasMaterial);
  const auto loaded = loadScene(*scene);
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_EQ(loaded->widthFactors, (std::vector<float>{1, 3, 1, 1, 3, 3}));
  EXPECT_TRUE(loadScene(*parsed(""))->widthFactors.empty());
}

TEST(SceneMaps, MistakesAreNamedWithLineAndRemedy) {
  const auto folder = test::scratchFolder("scene_maps_wrong");
  std::ofstream(folder / "wrong.csv") << "1;2\n";
  const struct {
    const char *text, *message;
  } kCases[] = {
      {"[[map]]\nstrands = \"0\"", "line 5: found a map with none of number, preset; expected one of them"},
      {"[[map]]\nnumber = \"bend_stiffness\"",
       "line 5: found a map with none of file, strands, primvar, texture"},
      {"[[map]]\nnumber = \"bend_stiffnes\"\nstrands = \"0\"", "did you mean bend_stiffness?"},
      {"[[map]]\nnumber = \"gravity_factor\"\nstrands = \"0\"",
       "line 6: found the text 'gravity_factor' for map.number"},
      {"[[map]]\nnumber = \"bend_stiffness\"\nstrands = \"x\"", "line 7: found 'x'; expected strands"},
      {"[[map]]\nnumber = \"bend_stiffness\"\nfile = \"none.csv\"", "none.csv"},
      {"[[map]]\nnumber = \"bend_stiffness\"\nfile = \"wrong.csv\"", "wrong.csv: line 1: found '1;2'"},
      {"[[map]]\nnumber = \"bend_stiffness\"\nstrands = \"0\"\nfactor = 0", "a number from 0.001 to 1000"},
      {"[[map]]\npreset = \"coil\"\nfile = \"wrong.csv\"", "only a number has factors"},
      {"[[map]]\npreset = \"coil\"\nstrands = \"0\"\nfactor = 2",
       "found map.factor with a preset; only a number has it"},
      {"[[map]]\nnumber = \"contacts.radius\"\nstrands = \"0\"",
       "line 6: found a map of contacts.radius without [contacts]"},
      {"[contacts]\n[[map]]\nnumber = \"contacts.radius\"\nfile = \"wrong.csv\"",
       "wrong.csv: line 1: found '1;2'"},
      {"[material]\ncore_stiffness = 0\n[[map]]\npreset = \"coil\"\nstrands = \"0\"",
       "a map cannot make coil of a material whose core_stiffness is 0"},
      {"[material]\nbend_damping_ratio = 50\n[[map]]\nnumber = \"bend_damping_ratio\"\nstrands = "
       "\"0\"\nfactor = 9",
       "maps make bend_damping_ratio of strand 0 450; it must be from 0 to 100"},
  };
  for (const auto& c : kCases) {
    const auto scene = parsed(c.text, folder);
    ASSERT_FALSE(scene) << c.text;
    EXPECT_NE(scene.error().message.find(c.message), std::string::npos) << scene.error().message;
  }
  // Two that are fine together, but for where the first has ended.
  const auto ended = parsed(
      "[material]\nbend_damping_ratio = 50\n[[map]]\nnumber = \"bend_damping_ratio\"\nstrands = "
      "\"0:3\"\nfactor = "
      "0.01\n[[map]]\nnumber = \"bend_damping_ratio\"\nstrands = \"0:4\"\nfactor = 9\n");
  ASSERT_FALSE(ended);
  EXPECT_NE(ended.error().message.find("maps make bend_damping_ratio of strand 4 450"), std::string::npos);
  const auto beyond = parsed("[[map]]\nnumber = \"bend_stiffness\"\nstrands = \"4:6\"\nfactor = 2\n");
  ASSERT_TRUE(beyond) << beyond.error().message;
  const auto loaded = loadScene(*beyond);
  ASSERT_FALSE(loaded);
  EXPECT_EQ(loaded.error().message, "a map names strand 6; the groom has 6, numbered from 0");
}

}  // namespace
}  // namespace ringlet::scene_maps_test
