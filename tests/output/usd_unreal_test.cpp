// What USD files have for Unreal's importer of grooms: a table of its schema's names, types and scopes, of
// text and crates; where each value comes from.
#include <gtest/gtest.h>

#include <algorithm>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ringlet/groom/groom_file.h"
#include "ringlet/groom/usd/usd_file.h"
#include "ringlet/output/animation_writer.h"
#include "tests/support/test_support.h"

namespace ringlet::usd_unreal_test {
namespace {

namespace fs = std::filesystem;
using test::scratchFolder;

constexpr std::string_view kText = R"(#usda 1.0
(
    metersPerUnit = 0.01
    upAxis = "Y"
)
def BasisCurves "Fringe"
{
    uniform token type = "linear"
    int[] curveVertexCounts = [3, 2]
    point3f[] points = [(0, 0, 0), (0, -1, 0.25), (0.5, -2, 0), (1, 0, 0), (1, -1.5, 0)]
SAID
}
)";

LoadedGroom groomSaying(std::string_view lines) {
  std::string text(kText);
  text.replace(text.find("SAID"), 4, lines);
  const auto bytes = std::as_bytes(std::span(text));
  auto read = readUsd({bytes.begin(), bytes.end()}, "groom.usda", {.keepsPrims = true});
  EXPECT_TRUE(read) << read.error().message;
  return read ? std::move(*read) : LoadedGroom{};
}

const std::vector<std::string> kEndings{".usda", ".usdc"};

fs::path write(const std::string& ending, const Groom& groom, UsdExtras extras) {
  extras.unreal = true;
  const fs::path path = scratchFolder("usd_unreal") / ("hair" + ending);
  auto writer =
      animationFormatOf(path)->resume(path, groom, {.diameter = 0.04f, .frameCount = 2, .usd = extras}, 0);
  EXPECT_TRUE(writer) << writer.error().message;
  for (int frame = 0; frame < 2; ++frame) EXPECT_TRUE((*writer)->addFrame(groom.points));
  EXPECT_TRUE((*writer)->finish());
  return path;
}

GroomPrim written(const std::string& ending, const Groom& groom, const UsdExtras& extras) {
  auto read = readGroom(write(ending, groom, extras), {.keepsPrims = true});
  EXPECT_TRUE(read) << read.error().message;
  if (!read || read->prims.size() != 1) {
    ADD_FAILURE() << "not one prim";
    return {};
  }
  return read->prims.front();
}

const GroomValue* find(const GroomPrim& prim, std::string_view name) {
  const auto found = std::ranges::find(prim.values, name, &GroomValue::name);
  return found == prim.values.end() ? nullptr : &*found;
}

struct Row {
  const char *name, *type, *scope;
  std::vector<double> numbers{};
  std::vector<std::string> texts{};
};

void expectRows(const GroomPrim& prim, const std::vector<Row>& rows) {
  for (const Row& row : rows) {
    SCOPED_TRACE(row.name);
    const GroomValue* value = find(prim, row.name);
    if (!value) {
      ADD_FAILURE() << "missing";
      continue;
    }
    EXPECT_EQ(value->type, row.type);
    EXPECT_EQ(value->interpolation, row.scope);
    EXPECT_EQ(value->texts, row.texts);
    ASSERT_EQ(value->numbers.size(), row.numbers.size());
    for (std::size_t i = 0; i < row.numbers.size(); ++i)
      EXPECT_EQ(static_cast<float>(value->numbers[i]), static_cast<float>(row.numbers[i])) << i;
  }
}

// Names, types and scopes are those of the schema, version 1.5.
TEST(UsdUnreal, EveryValueHasItsNameItsTypeAndItsScope) {
  const LoadedGroom groom = groomSaying(R"(
    float[] widths = [0.5] (interpolation = "constant")
    int[] primvars:id = [42, 7] (interpolation = "uniform")
    texCoord2f[] primvars:st = [(0, 1), (0.5, 0.75)] (interpolation = "uniform")
    color3f[] primvars:displayColor = [(1, 0, 0.5), (0.25, 1, 0)] (interpolation = "uniform")
    int[] primvars:groom_guide = [1, 0] (interpolation = "uniform")
    float[] primvars:groom_roughness = [0.1, 0.2, 0.3, 0.4, 0.5] (interpolation = "vertex")
    half[] primvars:groom_odd = [1, 2] (interpolation = "uniform"))");
  for (const std::string& ending : kEndings) {
    for (const bool isSaidToo : {false, true}) {
      SCOPED_TRACE(ending + (isSaidToo ? ", with the groom's own" : ""));
      const GroomPrim prim = written(ending, groom.groom,
                                     {.groupOf = {1, 0},
                                      .groupNames = {"fringe", "others"},
                                      .origin = &groom,
                                      .originValues = isSaidToo});
      const double width = isSaidToo ? 0.5 : 0.04f;
      expectRows(prim, {{"widths", "float[]", "uniform", {width, width}},
                        {"primvars:groom_id", "int[]", "uniform", {42, 7}},
                        {"primvars:groom_root_uv", "texCoord2f[]", "uniform", {0, 1, 0.5, 0.75}},
                        {"primvars:groom_color",
                         "float3[]",
                         "vertex",
                         {1, 0, 0.5, 1, 0, 0.5, 1, 0, 0.5, 0.25, 1, 0, 0.25, 1, 0}},
                        {"primvars:groom_guide", "int[]", "uniform", {1, 0}},
                        {"primvars:groom_roughness", "float[]", "vertex", {0.1, 0.2, 0.3, 0.4, 0.5}},
                        {"primvars:groom_group_id", "int[]", "uniform", {1, 0}},
                        {"primvars:groom_group_name", "string[]", "uniform", {}, {"others", "fringe"}}});
      // The importer reads no half; with all that the groom says it is there for others.
      EXPECT_EQ(find(prim, "primvars:groom_odd") != nullptr, isSaidToo);
    }
  }
}

// Whatever the file has of them.
TEST(UsdUnreal, WhatIsNotSaidIsMadeOrLeftOut) {
  const LoadedGroom groom = groomSaying("");
  for (const std::string& ending : kEndings) {
    SCOPED_TRACE(ending);
    const GroomPrim prim = written(ending, groom.groom, {.origin = &groom});
    expectRows(prim, {{"widths", "float[]", "uniform", {0.04f, 0.04f}},
                      {"primvars:groom_id", "int[]", "uniform", {0, 1}}});
    for (const char* name : {"primvars:groom_root_uv", "primvars:groom_color", "primvars:groom_guide",
                             "primvars:groom_group_id", "primvars:groom_group_name"})
      EXPECT_FALSE(find(prim, name)) << name;
    const GroomPrim tapered = written(ending, groom.groom, {.tipDiameter = 0.02f});
    expectRows(tapered, {{"widths", "float[]", "vertex", {0.04f, 0.03f, 0.02f, 0.04f, 0.02f}}});
  }
}

// Of any scope that they have.
TEST(UsdUnreal, UvsAndColoursOfEveryScope) {
  struct Case {
    const char *said, *name;
    std::vector<double> numbers;
  };
  const std::vector<Case> cases{
      {R"(float2[] primvars:uv = [(0, 1), (2, 3), (4, 5), (6, 7), (8, 9)] (interpolation = "vertex"))",
       "primvars:groom_root_uv",
       {0, 1, 6, 7}},
      {R"(float2[] primvars:UVMap = [(0, 1), (6, 7)] (interpolation = "uniform"))",
       "primvars:groom_root_uv",
       {0, 1, 6, 7}},
      {R"(color3f[] primvars:groom_color = [(1, 2, 3), (4, 5, 6)] (interpolation = "uniform"))",
       "primvars:groom_color",
       {1, 2, 3, 1, 2, 3, 1, 2, 3, 4, 5, 6, 4, 5, 6}},
      {R"(color3f[] primvars:displayColor = [(1, 2, 3)])",
       "primvars:groom_color",
       {1, 2, 3, 1, 2, 3, 1, 2, 3, 1, 2, 3, 1, 2, 3}},
      {R"(color3f[] primvars:displayColor = [(0, 0, 0), (1, 1, 1), (2, 2, 2), (3, 3, 3), (4, 4, 4)]
          (interpolation = "vertex"))",
       "primvars:groom_color",
       {0, 0, 0, 1, 1, 1, 2, 2, 2, 3, 3, 3, 4, 4, 4}}};
  for (const Case& c : cases) {
    SCOPED_TRACE(c.said);
    const LoadedGroom groom = groomSaying(c.said);
    for (const std::string& ending : kEndings) {
      const GroomPrim prim = written(ending, groom.groom, {.origin = &groom});
      const GroomValue* value = find(prim, c.name);
      ASSERT_TRUE(value) << ending;
      EXPECT_EQ(value->numbers, c.numbers) << ending;
    }
  }
}

// Alembic has the same parameters, by the same names without USD's.
TEST(UsdUnreal, AlembicHasThemToo) {
  const LoadedGroom groom = groomSaying(R"(
    int[] primvars:id = [42, 7] (interpolation = "uniform")
    texCoord2f[] primvars:st = [(0, 1), (0.5, 0.75)] (interpolation = "uniform")
    color3f[] primvars:displayColor = [(1, 2, 3)]
    int[] primvars:groom_guide = [1, 0] (interpolation = "uniform"))");
  const GroomPrim prim =
      written(".abc", groom.groom, {.groupOf = {1, 0}, .groupNames = {"fringe", "others"}, .origin = &groom});
  expectRows(prim,
             {{"widths", "float[]", "uniform", {0.04f, 0.04f}},
              {"primvars:groom_id", "int[]", "uniform", {42, 7}},
              {"primvars:groom_root_uv", "float2[]", "uniform", {0, 1, 0.5, 0.75}},
              {"primvars:groom_color", "float3[]", "vertex", {1, 2, 3, 1, 2, 3, 1, 2, 3, 1, 2, 3, 1, 2, 3}},
              {"primvars:groom_guide", "int[]", "uniform", {1, 0}},
              {"primvars:groom_group_id", "int[]", "uniform", {1, 0}},
              {"primvars:groom_group_name", "string[]", "uniform", {}, {"others", "fringe"}},
              {"primvars:groom_version_major", "int[]", "constant", {1}},
              {"primvars:groom_version_minor", "int[]", "constant", {5}},
              {"primvars:groom_tool", "string[]", "constant", {}, {"Ringlet"}}});
}

// Strand 1 follows strand 0, which is a guide. Ids are those of the file.
TEST(UsdUnreal, GuidesAndWhoFollowsThem) {
  const LoadedGroom groom = groomSaying(R"(int[] primvars:id = [42, 7] (interpolation = "uniform"))");
  const std::vector<ClosestGuides> closest{{.strands = {0, 0, 0}},
                                           {.strands = {0, 1, 0}, .shares = {0.75f, 0.25f, 0}}};
  for (const std::string ending : {".usda", ".usdc", ".abc"}) {
    SCOPED_TRACE(ending);
    const GroomPrim prim = written(ending, groom.groom, {.closestGuides = closest, .origin = &groom});
    expectRows(prim, {{"primvars:groom_guide", "int[]", "uniform", {1, 0}}});
    if (ending != ".abc") {  // three integers are none of the importer's types in USD
      EXPECT_FALSE(find(prim, "primvars:groom_closest_guides"));
      continue;
    }
    expectRows(prim, {{"primvars:groom_closest_guides", "int3[]", "uniform", {42, 42, 42, 42, 7, 42}},
                      {"primvars:groom_guide_weights", "float3[]", "uniform", {1, 0, 0, 0.75, 0.25, 0}}});
    EXPECT_FALSE(find(written(ending, groom.groom, {.origin = &groom}), "primvars:groom_closest_guides"));
  }
}

// The prim is a groom's; the schema's version is said of the whole.
TEST(UsdUnreal, ThePrimHasTheApiAndTheVersion) {
  const LoadedGroom groom = groomSaying("");
  const std::string text = test::readText(write(".usda", groom.groom, {}));
  for (const char* line :
       {"prepend apiSchemas = [\"GroomAPI\"]", "int userProperties:groom_version_major = 1",
        "int userProperties:groom_version_minor = 5", "string userProperties:groom_tool = \"Ringlet\""})
    EXPECT_NE(text.find(line), std::string::npos) << line;
  const std::string crate = test::readText(write(".usdc", groom.groom, {}));
  for (const char* token : {"apiSchemas", "GroomAPI"})
    EXPECT_NE(crate.find(token), std::string::npos) << token;
}

}  // namespace
}  // namespace ringlet::usd_unreal_test
