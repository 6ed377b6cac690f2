// Every command that writes a groom, in every format that grooms are written in; and that what a file says of
// its unit and axis holds for who reads it.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "ringlet/groom/groom_file.h"
#include "ringlet/output/groom_writer.h"
#include "tests/groom/groom_samples.h"
#include "tests/groom/usda_samples.h"
#include "tests/program/run_program.h"
#include "tests/support/test_support.h"

namespace ringlet::groom_formats_test {
namespace {

using nlohmann::json;
using test::contains;
using test::runProgram;
using test::scratchFolder;
using Arguments = std::vector<std::string>;

json jsonOf(const std::filesystem::path& folder, Arguments arguments) {
  arguments.push_back("--json");
  const auto result = runProgram(folder, arguments);
  EXPECT_EQ(result.exitCode, 0) << arguments[0] << " " << arguments[1] << ": " << result.err;
  return json::parse(result.out, nullptr, false);
}

// Two strands that hang from two places, in metres.
Groom twoStrands() {
  Groom groom;
  groom.addStrand(std::vector<Vec3f>{{0, 0, 0}, {0, -0.1f, 0.01f}, {0.01f, -0.2f, 0}});
  groom.addStrand(std::vector<Vec3f>{{0.02f, 0, 0}, {0.02f, -0.12f, 0}});
  groom.metresPerUnit = 1;
  return groom;
}

TEST(GroomFormats, EveryCommandWritesAllOfThem) {
  const auto folder = scratchFolder("groom_formats");
  ASSERT_TRUE(writeGroom(folder / "two.obj", twoStrands()));
  const Arguments commands[] = {
      {"make", "curl", "--turns", "2", "--particles", "20", "--quiet", "-o"},
      {"make", "swatch", "--columns", "3", "--rows", "2", "--turns", "2", "--particles", "9", "--quiet",
       "-o"},
      {"make", "head", "--strands", "25", "--turns", "0", "--particles", "16", "--quiet", "-o"},
      {"convert", "two.obj", "--unit", "1", "--up", "Y", "--quiet"},
      {"info", "two.obj", "--unit", "1", "--up", "Y", "--json", "--fix"}};
  for (const Arguments& command : commands) {
    Groom first;
    for (const WrittenGroomFormat& format : writtenGroomFormats()) {
      const std::string file = command[0] + command[1] + format.ending;
      SCOPED_TRACE(file);
      Arguments arguments = command;
      arguments.push_back(file);
      const auto result = runProgram(folder, arguments);
      ASSERT_EQ(result.exitCode, 0) << result.err;
      const auto loaded = readGroom(folder / file);
      ASSERT_TRUE(loaded) << loaded.error().message;
      if (first.points.empty()) first = loaded->groom;
      EXPECT_TRUE(test::hasSameBits(loaded->groom, first));
      EXPECT_EQ(loaded->statesUnit, format.isStating);
      EXPECT_EQ(loaded->statesUp, format.isStating);
      const bool isOfTwo = command[0] != "make";
      EXPECT_EQ(loaded->groom.metresPerUnit, isOfTwo && format.isStating ? 1 : 0.01);
      const bool warns = contains(result.err + result.out, "does not hold its unit");
      EXPECT_EQ(warns, isOfTwo && !format.isStating) << result.err << result.out;
    }
  }
}

TEST(GroomFormats, AnotherUnitAndAxisComeBackWithoutBeingSaid) {
  const auto folder = scratchFolder("groom_formats_unit");
  ASSERT_TRUE(writeGroom(folder / "two.obj", twoStrands()));
  for (const std::string name : {"two.abc", "two.usda", "two.usdc"}) {
    SCOPED_TRACE(name);
    const json out = jsonOf(folder, {"convert", "two.obj", name, "--unit", "1", "--up", "Z"});
    EXPECT_EQ(out["warnings"], json::array());
    const json info = jsonOf(folder, {"info", name});
    EXPECT_EQ(info["unit_from"], "file");
    EXPECT_EQ(info["metres_per_unit"], 1);
    EXPECT_EQ(info["strands"], 2);
    EXPECT_TRUE(contains(info["warnings"].dump(), "turned from Z up")) << info["warnings"];
    EXPECT_EQ(jsonOf(folder, {"info", name, "--unit", "0.5"})["unit_from"], "option");

    ASSERT_EQ(runProgram(folder, {"simulate", name, "--up", "Z", "--backend", "reference", "--frames", "2",
                                  "-o", name + ".out"})
                  .exitCode,
              0);
    EXPECT_EQ(jsonOf(folder, {"convert", name + ".out/hair.usda", "--info"})["metres_per_unit"], 1);
    ASSERT_EQ(runProgram(folder, {"convert", name, name + ".hair", "--up", "Z"}).exitCode, 0);
    EXPECT_EQ(readGroom(folder / (name + ".hair"))->groom.points, twoStrands().points);
  }
}

// Through all that say more than points, and back: the same values, and nothing else to be seen by `info`.
TEST(GroomFormats, ConvertKeepsWhatTheFileSaidOfItsCurves) {
  const auto folder = scratchFolder("groom_formats_values");
  test::writeText(folder / "said.usda", test::curves(test::kTwoStrands + R"(
float[] widths = [0.5, 0.25, 0.125, 0.5, 0.25] (interpolation = "vertex")
int[] primvars:id = [42, 7] (interpolation = "uniform")
texCoord2f[] primvars:st = [(0, 1), (0.5, 0.75)] (interpolation = "uniform")
string[] primvars:group = ["fringe", "back"] (interpolation = "uniform"))",
                                                     "(\n    metersPerUnit = 0.0254\n)\n"));
  const auto said = readGroom(folder / "said.usda", {.keepsPrims = true});
  ASSERT_TRUE(said) << said.error().message;
  json expected = jsonOf(folder, {"info", "said.usda"});
  std::string from = "said.usda";
  for (const std::string to : {"a.abc", "b.usdc", "c.abc", "d.usda", "e.usdc", "f.usda"}) {
    SCOPED_TRACE(from + " to " + to);
    ASSERT_EQ(runProgram(folder, {"convert", from, to}).exitCode, 0);
    from = to;
    const auto back = readGroom(folder / to, {.keepsPrims = true});
    ASSERT_TRUE(back) << back.error().message;
    EXPECT_TRUE(test::hasSameBits(back->groom, said->groom));
    ASSERT_EQ(back->prims.size(), 1u);
    for (const GroomValue& value : said->prims.front().values) {
      const auto& all = back->prims.front().values;
      const auto found = std::ranges::find(all, value.name, &GroomValue::name);
      ASSERT_NE(found, all.end()) << value.name;
      EXPECT_EQ(found->interpolation, value.interpolation) << value.name;
      EXPECT_EQ(found->numbers, value.numbers) << value.name;
      EXPECT_EQ(found->texts, value.texts) << value.name;
    }
    json info = jsonOf(folder, {"info", to});
    for (json* each : {&info, &expected}) each->erase("file");
    EXPECT_EQ(info, expected);
  }
}

// An axis that nobody stated is not made up: it can still be said of the new file.
TEST(GroomFormats, AnUnknownAxisStaysUnknown) {
  const auto folder = scratchFolder("groom_formats_axis");
  ASSERT_TRUE(writeGroom(folder / "two.obj", twoStrands()));
  for (const std::string name : {"two.abc", "two.usda", "two.usdc"}) {
    ASSERT_EQ(runProgram(folder, {"convert", "two.obj", name, "--unit", "1"}).exitCode, 0);
    const auto loaded = readGroom(folder / name, {.upIsZ = true});
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_FALSE(loaded->statesUp) << name;
    EXPECT_EQ(loaded->groom.points, twoStrands().points) << name;
  }
}

TEST(GroomFormats, WhatAGroomHasNotIsRefused) {
  const auto folder = scratchFolder("groom_formats_wrong");
  ASSERT_TRUE(writeGroom(folder / "two.obj", twoStrands()));
  struct Case {
    Arguments arguments;
    const char* part;
  };
  for (const Case& c : {Case{{"a.usdc", "--usd-values", "velocities"}, "a groom rests and has no velocities"},
                        Case{{"a.usda", "--clips", "2"}, "a groom has no frames, no clips"},
                        Case{{"a.usda", "--tip-width", "0.0001"}, "a groom's widths are its file's"},
                        Case{{"a.obj", "--usd-values", "id"}, "only USD and Alembic have it"}}) {
    Arguments arguments = c.arguments;
    arguments.insert(arguments.begin(), {"convert", "two.obj"});
    const auto result = runProgram(folder, arguments);
    EXPECT_EQ(result.exitCode, 2) << result.err;
    EXPECT_TRUE(contains(result.err, c.part)) << c.part << " in\n" << result.err;
  }
  ASSERT_EQ(runProgram(folder, {"convert", "two.obj", "a.usda", "--usd-values", "id,unreal"}).exitCode, 0);
  EXPECT_TRUE(contains(test::readText(folder / "a.usda"), "int[] primvars:groom_id = [0, 1]"));
  EXPECT_FALSE(std::filesystem::exists(folder / "a.obj"));
}

}  // namespace
}  // namespace ringlet::groom_formats_test
