// Guides of a scene: which strands are simulated, that all hairs keep their places at rest, and what becomes
// of numbers that strands have.
#include "ringlet/scenes/load/scene_guides.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <string>
#include <vector>

#include "ringlet/scenes/load/load_scene.h"
#include "tests/support/hairs_at_rest.h"
#include "tests/support/test_support.h"

namespace ringlet::scene_guides_test {
namespace {

namespace fs = std::filesystem;

constexpr const char* kHead = "[groom]\ngenerate = \"head\"\nstrands = 60\nparticles = 20\nturns = 3\n";

// Six straight strands of 3 to 8 points a centimetre apart, in metres; the second and the fifth are guides.
std::string usdGroom() {
  std::string counts, points, guides;
  for (int s = 0; s < 6; ++s) {
    counts += fmt::format("{}{}", s ? ", " : "", 3 + s);
    guides += fmt::format("{}{}", s ? ", " : "", s == 1 || s == 4 ? 1 : 0);
    for (int i = 0; i < 3 + s; ++i)
      points += fmt::format("{}({}, {}, {})", s + i ? ", " : "", 0.01 * s, -0.1 * i / (2 + s), 0.01 * i * i);
  }
  return fmt::format(
      "#usda 1.0\n(\n    metersPerUnit = 1\n    upAxis = \"Y\"\n)\ndef BasisCurves \"Hair\"\n{{\n"
      "    uniform token type = \"linear\"\n    int[] curveVertexCounts = [{}]\n    point3f[] points = [{}]\n"
      "    int[] primvars:groom_guide = [{}] (\n        interpolation = \"uniform\"\n    )\n}}\n",
      counts, points, guides);
}

// Two strands in centimetres.
std::string objGuides() {
  std::string text;
  for (int s = 0; s < 2; ++s)
    for (int i = 0; i < 5; ++i) text += fmt::format("v {} {} 0\n", 1 + 3 * s, -2.5 * i);
  return text + "l 1 2 3 4 5\nl 6 7 8 9 10\n";
}

class SceneGuides : public testing::Test {
 protected:
  void SetUp() override {
    std::ofstream(folder_ / "groom.usda") << usdGroom();
    std::ofstream(folder_ / "guides.obj") << objGuides();
  }
  Result<LoadedScene> loaded(const std::string& text) const {
    const auto scene = parseScene(text, "the scene", folder_);
    if (!scene) return scene.error();
    return loadScene(*scene);
  }
  LoadedScene scene(const std::string& text) const {
    auto made = loaded(text);
    EXPECT_TRUE(made) << made.error().message;
    return made ? std::move(*made) : LoadedScene{};
  }
  std::string wrong(const std::string& text) const {
    const auto made = loaded(text);
    return made ? "" : made.error().message;
  }
  const fs::path folder_ = test::scratchFolder("scene_guides");
};

TEST_F(SceneGuides, EveryHairKeepsItsPlace) {
  const std::string file = "[groom]\nfile = \"groom.usda\"\n";
  const std::string motion =
      "[[motion.key]]\ntime = 0\nposition = [0.2, 1, 0]\nrotate_degrees = [20, 70, -30]\n"
      "[[motion.key]]\ntime = 1\nposition = [0.3, 1, 0]\n";
  const struct {
    std::string groom, keys, rest;
    std::size_t guides;
  } cases[] = {{kHead, "guides = 12\n", "", 12},
               {kHead, "guides = 60\n", "", 60},
               {kHead, "guides = 1000\n", "", 60},
               {kHead, "guides = 12\nguides_sample = 7\n", "", 19},
               {kHead, "guides = 5\nguides_sample = 1000\n", "", 60},
               {file, "guides = 1\n", "", 1},
               {file, "guides_primvar = \"groom_guide\"\n", "", 2},
               {file, "guides_primvar = \"groom_guide\"\nscale = 2\nrotate_degrees = [0, 90, 10]\n", "", 2},
               {file, "guides_file = \"guides.obj\"\n", "", 2},
               {file, "guides_file = \"guides.obj\"\noffset = [0, 0.1, 0]\n", "", 2},
               {file, "guides = 3\nbind = \"world\"\n", motion, 3},
               {file, "guides_file = \"guides.obj\"\nbind = \"world\"\n", motion, 2}};
  for (const auto& c : cases) {
    SCOPED_TRACE(c.groom + c.keys + c.rest);
    const LoadedScene guided = scene(c.groom + c.keys + c.rest);
    ASSERT_TRUE(guided.level);
    EXPECT_EQ(guided.groom.strandCount(), c.guides);
    // The same without guides.
    std::string others = c.keys;
    for (std::size_t at; (at = others.find("guides")) != std::string::npos;)
      others.erase(at, others.find('\n', at) + 1 - at);
    const LoadedScene whole = scene(c.groom + others + c.rest);
    EXPECT_FALSE(whole.level);
    EXPECT_LT(test::farthestAtRest(*guided.level, whole.groom), 2e-7);
  }
}

TEST_F(SceneGuides, AreThoseThatAreNamed) {
  const LoadedScene named = scene("[groom]\nfile = \"groom.usda\"\nguides_primvar = \"groom_guide\"\n");
  EXPECT_EQ(named.level->guides, (std::vector<std::uint32_t>{1, 4}));
  const LoadedScene whole = scene("[groom]\nfile = \"groom.usda\"\n");
  for (std::size_t g = 0; g < 2; ++g)
    EXPECT_TRUE(std::ranges::equal(named.groom.strand(g), whole.groom.strand(named.level->guides[g])));
  // Another file's, in the groom's unit: they are no hairs.
  const LoadedScene other = scene("[groom]\nfile = \"groom.usda\"\nguides_file = \"guides.obj\"\nunit = 1\n");
  EXPECT_TRUE(other.level->guides.empty());
  EXPECT_EQ(other.level->hairs.size(), 6u);
  EXPECT_EQ(other.groom.strand(1).back(), (Vec3f{4, -10, 0}));
}

// Numbers of strands are those of the groom, whoever is simulated.
TEST_F(SceneGuides, HaveTheNumbersOfTheirStrands) {
  const std::string rest =
      "[contacts]\n[[group]]\nname = \"front\"\nstrands = \"0:29\"\ntouch = false\n"
      "[[map]]\nnumber = \"bend_stiffness\"\nstrands = \"10:19, 40\"\nfactor = 3\n"
      "[[map]]\nnumber = \"contacts.radius\"\nstrands = \"0:9\"\nfactor = 2\n"
      "[[map]]\nnumber = \"output.width\"\nstrands = \"20:39\"\nfactor = 0.5\n"
      "[[map]]\nnumber = \"output.hairs\"\nstrands = \"50:59\"\nfactor = 0.25\n";
  const LoadedScene whole = scene(kHead + rest);
  const LoadedScene guided = scene(std::string(kHead) + "guides = 20\nguides_sample = 10\n" + rest);
  std::vector<std::uint32_t> strands = guided.level->guides;
  strands.insert(strands.end(), guided.level->sample.begin(), guided.level->sample.end());
  ASSERT_EQ(strands.size(), 30u);
  ASSERT_EQ(guided.material.factors.size(), 1u);
  std::size_t stiff = 0, inBundle = 0;
  for (std::size_t k = 0; k < strands.size(); ++k) {
    EXPECT_EQ(guided.material.factors[0].of(k), whole.material.factors[0].of(strands[k])) << k;
    stiff += guided.material.factors[0].of(k) == 3;
    EXPECT_EQ((*guided.settings.contacts.radiusFactors)[k],
              (*whole.settings.contacts.radiusFactors)[strands[k]]);
    EXPECT_EQ(guided.hairs.densities[k], whole.hairs.densities[strands[k]]);
    const ContactBundle& bundle = guided.settings.contacts.bundles->front();
    EXPECT_EQ(std::ranges::count(bundle, k), strands[k] < 30 ? 1 : 0);
    inBundle += strands[k] < 30;
  }
  EXPECT_GT(stiff, 0u);
  EXPECT_GT(inBundle, 0u);
  EXPECT_EQ(guided.widthFactors, whole.widthFactors) << "they are those of all hairs, which are written";
}

TEST_F(SceneGuides, SayWhatDoesNotGoTogether) {
  const std::string file = "[groom]\nfile = \"groom.usda\"\n";
  const struct {
    std::string text, message;
  } cases[] = {
      {file + "guides = 2\nguides_primvar = \"groom_guide\"\n", "found several of groom.guides"},
      {file + "guides = 2\nguides_file = \"guides.obj\"\n", "found several of groom.guides"},
      {file + "guides_sample = 2\n", "groom.guides_sample has no effect without guides"},
      {file + "guides = 2\n[[cut]]\nstrands = \"0:5\"\nat = 0.5\ntime = 0.1\n", "[[cut]]"},
      {file + "guides_primvar = \"groom_gide\"\n", "groom_guide"},
      {file + "guides_file = \"none.obj\"\n", "the guides: "},
      {file + "guides_file = \"guides.obj\"\n[[map]]\nnumber = \"bend_stiffness\"\nstrands = \"0\"\nfactor = "
              "3\n",
       "[[map]]"},
      {file + "guides_file = \"guides.obj\"\n[[group]]\nname = \"a\"\nstrands = \"0:2\"\n", "[[group]]"},
      {"[groom]\ngenerate = \"head\"\nguides_primvar = \"groom_guide\"\n", "guides_primvar"}};
  for (const auto& c : cases) EXPECT_NE(wrong(c.text).find(c.message), std::string::npos) << wrong(c.text);
}

}  // namespace
}  // namespace ringlet::scene_guides_test
