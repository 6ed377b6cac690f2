// Maps by what a USD or Alembic groom says of its curves: primvars of every interpolation, textures at UVs;
// and groups.
#include "ringlet/scenes/load/strand_values.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <png.h>

#include <cmath>
#include <fstream>

#include "ringlet/groom/groom_file.h"
#include "ringlet/scenes/load/load_scene.h"
#include "ringlet/scenes/load/scene_maps.h"
#include "tests/groom/abc_curve_samples.h"
#include "tests/support/test_support.h"

namespace ringlet::strand_values_test {
namespace {

namespace fs = std::filesystem;

// Two prims, of two curves and of one, each of three points.
const std::string kGroom = R"(#usda 1.0
(
    metersPerUnit = 1
    upAxis = "Y"
)
def BasisCurves "Back"
{
    uniform token type = "linear"
    int[] curveVertexCounts = [3, 3]
    point3f[] points = [(0, 0, 0), (0, -0.1, 0), (0, -0.2, 0), (1, 0, 0), (1, -0.1, 0), (1, -0.2, 0)]
    float[] primvars:soft = [0.5, 2] (
        interpolation = "uniform"
    )
    color3f[] primvars:tint = [(0.2, 0.4, 0.6), (0, 0, 0), (0, 0, 0), (1, 1, 1), (0, 0, 0), (0, 0, 0)] (
        interpolation = "vertex"
    )
    float primvars:all = 3 (
        interpolation = "constant"
    )
    texCoord2f[] primvars:st = [(0.75, 0.25), (0.25, 0.75)] (
        interpolation = "uniform"
    )
    int[] primvars:st:indices = [1, 0]
    string[] primvars:name = ["a", "b"] (
        interpolation = "uniform"
    )
}
def BasisCurves "Front"
{
    uniform token type = "linear"
    int[] curveVertexCounts = [3]
    point3f[] points = [(2, 0, 0), (2, -0.1, 0), (2, -0.2, 0)]
    float[] primvars:soft = [8] (
        interpolation = "uniform"
    )
    color3f[] primvars:tint = [(0.5, 0.5, 0.5), (0, 0, 0), (0, 0, 0)] (
        interpolation = "vertex"
    )
    float primvars:all = 4 (
        interpolation = "constant"
    )
    texCoord2f[] primvars:st = [(0.5, 0.5)] (
        interpolation = "uniform"
    )
    float[] primvars:only = [1] (
        interpolation = "uniform"
    )
}
)";

class StrandValues : public testing::Test {
 protected:
  void SetUp() override {
    std::ofstream(folder_ / "groom.usda") << kGroom;
    auto read = readGroom(folder_ / "groom.usda", {.keepsPrims = true});
    ASSERT_TRUE(read) << read.error().message;
    groom_ = std::move(*read);
    ASSERT_EQ(groom_.groom.strandCount(), 3u);
    // Two by two: the highest row first.
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = image.height = 2;
    image.format = PNG_FORMAT_GRAY;
    const unsigned char pixels[] = {0, 51, 102, 255};
    ASSERT_TRUE(png_image_write_to_file(&image, (folder_ / "map.png").c_str(), 0, pixels, 0, nullptr));
  }
  std::vector<double> of(const std::string& name) const {
    auto values = valuesOfPrimvar(groom_, name);
    EXPECT_TRUE(values) << values.error().message;
    return values ? *values : std::vector<double>{};
  }
  Result<LoadedScene> loaded(const std::string& maps) const {
    auto scene = parseScene("[groom]\nfile = \"groom.usda\"\n[material]\nbend_stiffness = 10\n" + maps,
                            "scene.toml", folder_);
    if (!scene) return scene.error();
    const auto again = parseScene(sceneText(*scene, folder_), "again", folder_);
    EXPECT_TRUE(again) << again.error().message;
    EXPECT_TRUE(again->maps == scene->maps && again->groups == scene->groups);
    return loadScene(*scene);
  }
  static void expectStiffness(const Result<LoadedScene>& scene, std::vector<double> expected) {
    ASSERT_TRUE(scene) << scene.error().message;
    for (std::size_t s = 0; s < expected.size(); ++s)
      EXPECT_NEAR(materialOfStrand(scene->material, s).bendStiffness, expected[s], 1e-5 * expected[s]) << s;
  }

  fs::path folder_ = test::scratchFolder("strand_values");
  LoadedGroom groom_;
};

TEST_F(StrandValues, PrimvarsAreOfEveryInterpolation) {
  EXPECT_EQ(of("soft"), (std::vector<double>{0.5, 2, 8}));
  EXPECT_EQ(of("primvars:soft"), of("soft"));
  EXPECT_EQ(of("all"), (std::vector<double>{3, 3, 4}));
  const std::vector<double> tint = of("tint");  // at the roots, the mean
  for (std::size_t s = 0; s < 3; ++s) EXPECT_NEAR(tint[s], (std::vector<double>{0.4, 1, 0.5})[s], 1e-6);
  std::size_t width = 0;
  const auto st = primvarOfStrands(groom_, "st", width);
  ASSERT_TRUE(st) << st.error().message;
  EXPECT_EQ(width, 2u);
  EXPECT_EQ(*st, (std::vector<double>{0.25, 0.75, 0.75, 0.25, 0.5, 0.5})) << "the first prim's are indexed";
}

TEST_F(StrandValues, TexturesAreReadAtUvs) {
  const auto grey = valuesOfTexture(groom_, folder_ / "map.png", "st");
  ASSERT_TRUE(grey) << grey.error().message;
  // The middles of the pixel at the top left and at the bottom right, and between all four.
  EXPECT_NEAR((*grey)[0], 0, 1e-12);
  EXPECT_NEAR((*grey)[1], 1, 1e-12);
  EXPECT_NEAR((*grey)[2], (0 + 51 + 102 + 255) / 4.0 / 255, 1e-12);
}

TEST_F(StrandValues, BecomeFactors) {
  expectStiffness(loaded("[[map]]\nnumber = \"bend_stiffness\"\nprimvar = \"soft\"\n"), {5, 20, 80});
  expectStiffness(loaded("[[map]]\nnumber = \"bend_stiffness\"\nprimvar = \"tint\"\nlow = 2\nhigh = 4\n"),
                  {28, 40, 30});
  expectStiffness(
      loaded("[[map]]\nnumber = \"bend_stiffness\"\ntexture = \"map.png\"\nlow = 0.5\nhigh = 1\n"),
      {5, 10, 10 * (0.5 + 0.5 * 0.4)});
  // Black is as little as there may be.
  expectStiffness(loaded("[[map]]\nnumber = \"bend_stiffness\"\ntexture = \"map.png\"\n"), {0.01, 10, 4});
}

// Parameters of Alembic are maps as primvars of USD are, whatever their type: numbers, groups and UVs.
TEST_F(StrandValues, AreOfAlembicTooForNumbersOfEveryType) {
  const std::string uv = test::abcNumbers<float>({0.75f, 0.25f, 0.25f, 0.75f});
  const std::pair<std::uint32_t, std::string> types[] = {
      {1, test::abcNumbers<std::uint8_t>({2, 5})},
      {2, test::abcNumbers<std::int8_t>({2, 5})},
      {3, test::abcNumbers<std::uint16_t>({2, 5})},
      {4, test::abcNumbers<std::int16_t>({2, 5})},
      {5, test::abcNumbers<std::uint32_t>({2, 5})},
      {6, test::abcNumbers<std::int32_t>({2, 5})},
      {7, test::abcNumbers<std::uint64_t>({2, 5})},
      {8, test::abcNumbers<std::int64_t>({2, 5})},
      {9, test::abcNumbers<std::uint16_t>({0x4000, 0x4500})},
      {10, test::abcNumbers<float>({2, 5})},
      {11, test::abcNumbers<double>({2, 5})}};
  for (const auto& [type, bytes] : types) {
    test::AbcCurveForm form;
    form.more = {test::abcArray("uv", test::AbcBytes::f32, uv, 2, "geoScope=uni")};
    form.params = {test::abcArray("soft", static_cast<test::AbcBytes::Type>(type), bytes, 1, "geoScope=uni")};
    std::ofstream(folder_ / "groom.abc", std::ios::binary)
        << test::abcFile({test::abcCurves("hair", {3, 2}, test::abcCurl({3, 2}), form)});
    const auto stiffness = [&](const std::string& map) {
      const auto scene = parseScene(
          "[groom]\nfile = \"groom.abc\"\n[material]\nbend_stiffness = 10\n"
          "[[map]]\nnumber = \"bend_stiffness\"\n" +
              map,
          "scene.toml", folder_);
      return scene ? loadScene(*scene) : Result<LoadedScene>(scene.error());
    };
    expectStiffness(stiffness("primvar = \"soft\"\n"), {20, 50});
    expectStiffness(stiffness("texture = \"map.png\"\nlow = 0.5\nhigh = 1\n"), {10, 5});
  }
}

TEST_F(StrandValues, GroupsNameStrands) {
  const std::string groups =
      "[[group]]\nname = \"front\"\nstrands = \"2\"\n[[group]]\nname = \"both\"\nstrands = "
      "\"0, front\"\n";
  expectStiffness(loaded(groups + "[[map]]\nnumber = \"bend_stiffness\"\nstrands = \"both\"\nfactor = 3\n"),
                  {30, 10, 30});
  const auto held = loaded(groups + "[[hold]]\nstrands = \"front\"\nstrength = 5\n");
  ASSERT_TRUE(held) << held.error().message;
  const auto goals = held->forces.goalsAt(0, {}, {}, nullptr);
  EXPECT_EQ(goals->strengths[1], 0);
  EXPECT_EQ(goals->strengths[7], 5);
}

TEST_F(StrandValues, MistakesAreNamed) {
  std::ofstream(folder_ / "no.png") << "no picture";
  const std::string map = "[[map]]\nnumber = \"bend_stiffness\"\n";
  const struct {
    std::string text;
    const char* message;
  } kCases[] = {
      {map + "primvar = \"sfot\"\n", "line 7: /Back has no primvar 'sfot'; did you mean soft?"},
      {map + "primvar = \"only\"\n", "line 7: /Back has no primvar 'only'"},
      {map + "primvar = \"name\"\n", "line 7: "},
      {map + "texture = \"no.png\"\n", "cannot read it as a PNG file"},
      {map + "texture = \"none.png\"\n", "line 7: "},
      {map + "texture = \"map.png\"\nuv = \"soft\"\n",
       "the primvar 'soft' has 1 numbers; expected two, u and v"},
      {map + "primvar = \"soft\"\nhigh = 900\n",
       "strand 1 has the factor 1800; expected one of at most 1000"},
      {map + "primvar = \"soft\"\nfactor = 2\n",
       "line 8: found map.factor with a map of primvar; only strands"},
      {map + "strands = \"0\"\nlow = 2\n", "line 8: found map.low with a map of strands; only"},
      {map + "primvar = \"soft\"\nstrands = \"0\"\n",
       "found a map with 2 of file, strands, primvar, texture"},
      {map, "line 5: found a map with none of file, strands, primvar, texture"},
      {"[[map]]\npreset = \"coil\"\nprimvar = \"soft\"\n", "line 7: found a preset for other than strands"},
      {map + "strands = \"fringe\"\n", "line 7: found 'fringe'; expected strands from 0"},
      {"[[group]]\nname = \"a\"\nstrands = \"b\"\n[[group]]\nname = \"b\"\nstrands = \"1\"\n",
       "line 7: group.strands: found 'b'"},
      {"[[group]]\nname = \"7\"\nstrands = \"1\"\n", "a name that begins with a letter"},
      {"[[group]]\nname = \"a\"\n", "found a group without strands"},
  };
  for (const auto& c : kCases) {
    const auto scene = parseScene(
        "[groom]\nfile = \"groom.usda\"\n[material]\nbend_stiffness = 10\n" + c.text, "scene.toml", folder_);
    ASSERT_FALSE(scene) << c.text;
    EXPECT_NE(scene.error().message.find(c.message), std::string::npos) << c.text << scene.error().message;
  }
  const auto generated =
      parseScene("[groom]\ngenerate = \"curl\"\n" + map + "primvar = \"soft\"\n", "scene.toml");
  ASSERT_FALSE(generated);
  EXPECT_NE(generated.error().message.find("primvars and UVs are of USD and Alembic grooms"),
            std::string::npos);
}

}  // namespace
}  // namespace ringlet::strand_values_test
