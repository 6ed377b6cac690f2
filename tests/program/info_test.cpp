// `ringlet info` as a user runs it: what it says of a groom, what it mends, and grooms of other programs in
// every command.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "ringlet/groom/groom_file.h"
#include "ringlet/output/groom_writer.h"
#include "tests/groom/crate_bytes.h"
#include "tests/groom/usda_samples.h"
#include "tests/measure/strand_samples.h"
#include "tests/program/run_program.h"
#include "tests/support/test_support.h"

namespace ringlet::info_test {
namespace {

using namespace test;
using nlohmann::json;

json jsonOf(const std::filesystem::path& folder, std::vector<std::string> arguments) {
  arguments.push_back("--json");
  const ProgramResult result = runProgram(folder, arguments);
  EXPECT_EQ(result.exitCode, 0) << result.err;
  return json::parse(result.out, nullptr, false);
}
void write(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

// Two straight strands of so many units, hanging along -Y, of five particles.
std::string straight(double length, const std::string& metadata) {
  std::string points, counts;
  for (int s = 0; s < 2; ++s) {
    counts += s == 0 ? "5" : ", 5";
    for (int i = 0; i < 5; ++i) points += fmt::format("({}, {}, 0), ", s * 0.1 * length, -length * i / 4);
  }
  return curves("uniform token type = \"linear\" int[] curveVertexCounts = [" + counts +
                    "] point3f[] points = [" + points + "]",
                metadata);
}

TEST(Info, SaysHowLongAndHowCurled) {
  const auto folder = scratchFolder("info_curl");
  const ProgramResult made = runProgram(folder, {"make", "curl", "--radius", "0.01", "--turns", "8",
                                                 "--length", "0.25", "--particles", "200", "-o", "curl.obj"});
  ASSERT_EQ(made.exitCode, 0) << made.err;
  const json found = jsonOf(folder, {"info", "curl.obj"});
  EXPECT_EQ(found["strands"], 1);
  EXPECT_EQ(found["particles"], 200);
  EXPECT_EQ(found["particles_per_strand"]["median"], 200);
  // A helix of 199 edges, each a chord of its share of the eight turns and of the way along.
  const double edge = std::hypot(2 * 0.01 * std::sin(kPi * 8 / 199), 0.25 / 199), arc = 199 * edge;
  EXPECT_NEAR(found["length_mm"]["mean"].get<double>(), 1000 * arc, 1e-5 * 1000 * arc);
  EXPECT_NEAR(found["length"]["max"].get<double>(), 100 * arc, 1e-5 * 100 * arc);
  EXPECT_NEAR(found["arc_over_chord"]["median"].get<double>(), arc / 0.25, 1e-5);
  EXPECT_EQ(found["curled"], 1);
  EXPECT_NEAR(found["turns"]["median"].get<double>(), 8, 0.05);
  EXPECT_NEAR(found["radius_mm"]["median"].get<double>(), 10, 0.05);
  EXPECT_EQ(found["metres_per_unit"], 0.01);
  EXPECT_EQ(found["unit_from"], "default");
  EXPECT_EQ(found["likely_up"], "Y");
  EXPECT_TRUE(found["up_from"].is_null());
  EXPECT_TRUE(found["at_rest"].is_null());
  // 56 units long: of a head in cm and, at 5.6 cm, in mm.
  ASSERT_EQ(found["likely_units"].size(), 2u);
  EXPECT_EQ(found["likely_units"][0]["name"], "cm");
  EXPECT_EQ(found["likely_units"][1]["name"], "mm");
  for (const auto& [key, fault] : found["faults"].items()) {
    EXPECT_EQ(fault["count"], 0) << key;
    EXPECT_TRUE(fault["first_strand"].is_null());
    EXPECT_TRUE(fault["strands"].empty());
    for (const char* sentence : {"means", "fix"})
      EXPECT_TRUE(fault[sentence].get<std::string>().ends_with(".")) << key;
  }
  EXPECT_FALSE(found.contains("fixed"));

  const ProgramResult text = runProgram(folder, {"info", "curl.obj"});
  EXPECT_EQ(text.exitCode, 0);
  for (const char* part : {"1 strand, 200 particles", "the usual one; the file states none",
                           "cm (--unit 0.01", "hang along -Y", "1 of 1 strands: 8", "faults        none"})
    EXPECT_NE(text.out.find(part), std::string::npos) << part << " in\n" << text.out;
}

TEST(Info, TakesTheUnitFromOptionOrFile) {
  const auto folder = scratchFolder("info_unit");
  write(folder / "a.usda", straight(0.2, "( metersPerUnit = 1 upAxis = \"Y\" )"));
  const json stated = jsonOf(folder, {"info", "a.usda"});
  EXPECT_EQ(stated["unit_from"], "file");
  EXPECT_EQ(stated["up_from"], "file");
  EXPECT_NEAR(stated["length_mm"]["mean"].get<double>(), 200, 1e-3);
  const json typed = jsonOf(folder, {"info", "a.usda", "--unit", "0.1"});
  EXPECT_EQ(typed["unit_from"], "option");
  EXPECT_NEAR(typed["length_mm"]["mean"].get<double>(), 20, 1e-4);
}

TEST(Info, FindsFaultsAndMendsThem) {
  const auto folder = scratchFolder("info_fix");
  Groom groom;
  for (int s = 0; s < 8; ++s) {
    std::vector<Vec3f> strand;
    for (int i = 0; i < 10; ++i) strand.push_back({float(s), -float(i), 0});
    groom.addStrand(strand);
  }
  // Repeated in the middle and at the tip; all in one place; twice there; far too short; far away.
  groom.addStrand(std::vector<Vec3f>{{3, 0, 1}, {3, -1, 1}, {3, -1, 1}, {3, -1, 1}, {3, -9, 1}, {3, -9, 1}});
  groom.addStrand(std::vector<Vec3f>{{5, 0, 0}, {5, 0, 0}, {5, 0, 0}});
  groom.addStrand(std::vector<Vec3f>(groom.strand(2).begin(), groom.strand(2).end()));
  groom.addStrand(std::vector<Vec3f>{{1, 0, 1}, {1, -0.1f, 1}});
  groom.addStrand(std::vector<Vec3f>{{900, 0, 0}, {900, -9, 0}});
  ASSERT_TRUE(writeGroom(folder / "bad.obj", groom));

  const json found = jsonOf(folder, {"info", "bad.obj"});
  const auto expectFault = [&](const char* key, int count, int strand) {
    EXPECT_EQ(found["faults"][key]["count"], count) << key;
    EXPECT_EQ(found["faults"][key]["first_strand"], strand) << key;
  };
  expectFault("repeated_particles", 3, 8);
  expectFault("point_strands", 1, 9);
  expectFault("duplicates", 1, 10);
  expectFault("too_short", 1, 11);
  expectFault("far_away", 1, 12);
  EXPECT_EQ(found["faults"]["too_long"]["count"], 0);

  const json fixed = jsonOf(folder, {"info", "bad.obj", "--fix", "good.hair", "--particles", "7"})["fixed"];
  EXPECT_EQ(fixed["strands"], 10);
  EXPECT_EQ(fixed["particles"], 70);
  EXPECT_EQ(fixed["merged"], 3);
  EXPECT_EQ(fixed["dropped_points"], 1);
  EXPECT_EQ(fixed["dropped_duplicates"], 1);
  EXPECT_EQ(fixed["dropped_strays"], 1);
  const auto good = readGroom(folder / "good.hair");
  ASSERT_TRUE(good);
  for (std::size_t s = 0; s < 10; ++s) ASSERT_EQ(good->groom.strand(s).size(), 7u);
  // Nine long, cut into six.
  for (std::size_t i = 0; i < 7; ++i)
    EXPECT_LT(length(good->groom.strand(8)[i] - Vec3f{3, -1.5f * float(i), 1}), 1e-5f) << i;
  const json after = jsonOf(folder, {"info", "good.hair"});
  for (const char* key : {"repeated_particles", "point_strands", "duplicates"})
    EXPECT_EQ(after["faults"][key]["count"], 0) << key;

  const ProgramResult text = runProgram(folder, {"info", "bad.obj", "--fix", "same.obj"});
  for (const char* part :
       {"repeated particles: 3 (the first in strand 8)", "strands that are there twice: 1",
        "same.obj: 10 strands", "3 particles merged", "strands that are there twice: 1, then 0",
        "They cost time twice", "--fix drops all but the first."})
    EXPECT_NE(text.out.find(part), std::string::npos) << part << " in\n" << text.out;
}

// What was wrong, in which strands, what --fix did and what is left.
TEST(Info, SaysWhatWasWrongBeforeAndIsAfterwards) {
  const auto folder = scratchFolder("info_doctor");
  ASSERT_EQ(runProgram(folder, {"make", "head", "--strands", "200", "-o", "head.hair"}).exitCode, 0);
  auto head = readGroom(folder / "head.hair");
  ASSERT_TRUE(head);
  Groom bad;
  for (std::size_t s = 0; s < 200; ++s) {
    std::vector<Vec3f> strand(head->groom.strand(s).begin(), head->groom.strand(s).end());
    if (s % 50 == 3) std::reverse(strand.begin(), strand.end());
    for (Vec3f& p : strand) {
      if (s == 10) p = p + strand.front() * (3 / length(strand.front()));
    }
    bad.addStrand(strand);
  }
  ASSERT_TRUE(writeGroom(folder / "bad.hair", bad));
  const json found = jsonOf(folder, {"info", "bad.hair", "--fix", "good.hair"});
  EXPECT_EQ(found["faults"]["reversed_strands"]["strands"], (json{3, 53, 103, 153}));
  EXPECT_EQ(found["fixed"]["turned"], 4);
  for (const auto& [key, fault] : found["fixed"]["faults"].items()) EXPECT_EQ(fault["count"], 0) << key;
  EXPECT_EQ(jsonOf(folder, {"info", "good.hair"})["faults"], found["fixed"]["faults"]);
  EXPECT_GT(found["at_rest"]["width"].get<double>(), 0.3);
  EXPECT_GE(found["at_rest"]["overlapping_pairs"], found["at_rest"]["crossing_pairs"]);

  const ProgramResult wrong = runProgram(folder, {"info", "bad.hair", "--scalp", "none.obj"});
  EXPECT_EQ(wrong.exitCode, 4) << wrong.err;
  EXPECT_NE(wrong.err.find("none.obj"), std::string::npos) << wrong.err;
  EXPECT_EQ(runProgram(folder, {"info", "bad.hair", "--scalp", "none.stl"}).exitCode, 2);
}

// A box under the roots of straight hair in units of 1 cm; then one of which they are all far off.
TEST(Info, AScalpSaysWhichRootsAreOff) {
  const auto folder = scratchFolder("info_scalp");
  Groom groom;
  for (int s = 0; s < 25; ++s) {
    std::vector<Vec3f> strand;
    for (int i = 0; i < 9; ++i)
      strand.push_back(
          {float(s % 5), (s == 7 ? 3.f : 0.f) - float(i), 4 + float(s) / 5 + (i > 0 ? 4.f : 0.f)});
    groom.addStrand(strand);
  }
  ASSERT_TRUE(writeGroom(folder / "groom.obj", groom));
  const auto box = [&](const char* name, int top) {
    std::string text;
    for (int k = 0; k < 8; ++k)
      text += fmt::format("v {} {} {}\n", k & 1 ? 14 : -10, k & 2 ? top : top - 12, k & 4 ? 16 : -8);
    write(folder / name, text + "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n");
  };
  box("near.obj", 0);
  box("far.obj", -3);
  const json near = jsonOf(folder, {"info", "groom.obj", "--scalp", "near.obj", "--fix", "fixed.obj"});
  EXPECT_EQ(near["faults"]["floating_roots"]["strands"], json::array({7}));
  EXPECT_EQ(near["fixed"]["moved"], 1);
  EXPECT_EQ(near["fixed"]["faults"]["floating_roots"]["count"], 0);
  EXPECT_LT(std::abs(readGroom(folder / "fixed.obj")->groom.strand(7)[0].y), 0.2f);
  const json far = jsonOf(folder, {"info", "groom.obj", "--scalp", "far.obj", "--fix", "same.obj"});
  EXPECT_EQ(far["faults"]["floating_roots"]["count"], 25);
  EXPECT_EQ(far["fixed"]["moved"], 0);
  EXPECT_NE(far["warnings"].dump().find("25 of 25 roots are off the scalp"), std::string::npos);
}

TEST(Info, WarnsWhereACurlWouldBeLost) {
  const auto folder = scratchFolder("info_particles");
  ASSERT_EQ(runProgram(folder, {"make", "curl", "--turns", "8", "-o", "curl.obj"}).exitCode, 0);
  const ProgramResult few = runProgram(folder, {"info", "curl.obj", "--fix", "a.obj", "--particles", "12"});
  EXPECT_EQ(few.exitCode, 0);
  EXPECT_NE(few.err.find("12 particles are fewer than four a turn"), std::string::npos) << few.err;
  EXPECT_EQ(runProgram(folder, {"info", "curl.obj", "--fix", "a.obj", "--particles", "48"}).err, "");
}

TEST(Info, SaysWhatIsWrong) {
  const auto folder = scratchFolder("info_wrong");
  write(folder / "nan.obj", "v 0 0 nan\nv 0 1 0\nl 1 2\n");
  write(folder / "point.obj", "v 0 0 0\nv 0 0 0\nl 1 2\n");
  write(folder / "mesh.usda", "#usda 1.0\ndef Mesh \"A\" {}\n");
  struct Case {
    std::vector<std::string> arguments;
    int exitCode;
    const char* part;
  };
  for (const Case& c :
       {Case{{"missing.usd"}, 4, "missing.usd"}, Case{{"a.xyz"}, 1, "supported are .hair, .obj, .usda"},
        Case{{"nan.obj"}, 1, "line 1"}, Case{{"mesh.usda"}, 1, "found no BasisCurves"},
        Case{{"point.obj", "--fix", "a.obj"}, 1, "nothing is left to write"},
        Case{{"point.obj", "--fix", "a.tfx"}, 2, "a.tfx"},
        Case{{"point.obj", "--particles", "4"}, 2, "only --fix"}, Case{{}, 2, "FILE"}}) {
    auto arguments = c.arguments;
    arguments.insert(arguments.begin(), "info");
    const ProgramResult result = runProgram(folder, arguments);
    EXPECT_EQ(result.exitCode, c.exitCode) << result.err;
    EXPECT_NE(result.err.find(c.part), std::string::npos) << c.part << " in\n" << result.err;
  }
}

// --- Grooms of other programs in the other commands.

class UsdGroom : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = scratchFolder("usd_groom");
    write(folder_ / "metres.usda", straight(0.2, "( metersPerUnit = 1 upAxis = \"Y\" )"));
    write(folder_ / "plain.usda", straight(20, ""));
    write(folder_ / "crate.usdc", CrateBytes::small().bytes());
  }
  std::filesystem::path folder_;
};

TEST_F(UsdGroom, IsSimulatedInItsOwnUnit) {
  const auto run = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "simulate");
    arguments.insert(arguments.end(),
                     {"--backend", "reference", "--frames", "2", "--overwrite", "-o", "out"});
    return jsonOf(folder_, arguments);
  };
  const json metres = run({"metres.usda"}), centimetres = run({"plain.usda"});
  EXPECT_EQ(metres["warnings"], json::array());
  // The same hair: 20 cm of it, by what the file states and by what is usual.
  EXPECT_EQ(metres["steps_per_frame"], centimetres["steps_per_frame"]);
  EXPECT_EQ(jsonOf(folder_, {"convert", "out/hair.usda", "--info"})["metres_per_unit"], 0.01);
  run({"metres.usda"});
  const json written = jsonOf(folder_, {"convert", "out/hair.usda", "--info"});
  EXPECT_EQ(written["metres_per_unit"], 1);
  EXPECT_EQ(written["up"], "Y");
  run({"metres.usda", "--unit", "0.5"});
  EXPECT_EQ(jsonOf(folder_, {"convert", "out/hair.usda", "--info"})["metres_per_unit"], 0.5);

  // Z up: turned, and said; or kept, and written so.
  const json turned = run({"crate.usdc"});
  ASSERT_EQ(turned["warnings"].size(), 1u) << turned["warnings"];
  EXPECT_NE(turned["warnings"].dump().find("turned from Z up"), std::string::npos);
  EXPECT_EQ(jsonOf(folder_, {"convert", "out/hair.usda", "--info"})["up"], "Y");
  EXPECT_EQ(run({"crate.usdc", "--up", "Z"})["warnings"], json::array());
  EXPECT_EQ(jsonOf(folder_, {"convert", "out/hair.usda", "--info"})["up"], "Z");
}

TEST_F(UsdGroom, IsAScenesGroom) {
  write(folder_ / "scene.toml", "[groom]\nfile = \"metres.usda\"\n[simulation]\nframes = 1\n");
  write(folder_ / "unit.toml", "[groom]\nfile = \"metres.usda\"\nunit = 0.25\n[simulation]\nframes = 1\n");
  for (const auto& [file, unit] : {std::pair{"scene.toml", 1.0}, {"unit.toml", 0.25}}) {
    ASSERT_EQ(runProgram(folder_, {"simulate", file, "--backend", "reference", "--overwrite", "-o", "out"})
                  .exitCode,
              0);
    EXPECT_EQ(jsonOf(folder_, {"convert", "out/hair.usda", "--info"})["metres_per_unit"], unit) << file;
  }
}

// A body's mesh that states no unit has the groom's, be it the file's own: a ball of radius 0.5 around the
// roots holds them.
TEST_F(UsdGroom, LendsABodyItsUnit) {
  write(folder_ / "box.obj",
        "v -0.1 -0.1 -0.1\nv 0.3 -0.1 -0.1\nv 0.3 0.1 -0.1\nv -0.1 0.1 -0.1\nv -0.1 -0.1 0.1\nv 0.3 -0.1 "
        "0.1\nv 0.3 0.1 "
        "0.1\nv -0.1 0.1 0.1\nf 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n");
  const std::string scene =
      "[groom]\nfile = \"metres.usda\"\n[simulation]\nframes = 1\n[[body]]\nshape = \"mesh\"\nfile = "
      "\"box.obj\"\n";
  write(folder_ / "own.toml", scene);
  write(folder_ / "small.toml", scene + "unit = 0.01\n");
  // Below the roots, which are the head's, there is a particle each at 5 cm: within 10 cm, and not within 1
  // mm.
  for (const auto& [file, count] : {std::pair{"own.toml", 2}, {"small.toml", 0}}) {
    const json run =
        jsonOf(folder_, {"simulate", file, "--backend", "reference", "--overwrite", "-o", "out"});
    EXPECT_EQ(run["inside_bodies"], count) << run;
  }
}

TEST_F(UsdGroom, IsMeasuredBesideOthers) {
  EXPECT_NEAR(jsonOf(folder_, {"measure", "metres.usda"})["spread"]["core_length_mm"][0].get<double>(), 200,
              0.1);
  EXPECT_NEAR(jsonOf(folder_, {"measure", "metres.usda", "--unit", "0.1"})["spread"]["core_length_mm"][0]
                  .get<double>(),
              20, 0.01);
  // Another pose in another unit, which it states: the same hair.
  write(folder_ / "centimetres.usda", straight(20, "( metersPerUnit = 0.01 )"));
  const ProgramResult both = runProgram(folder_, {"measure", "metres.usda", "centimetres.usda", "--json"});
  EXPECT_EQ(both.exitCode, 0) << both.err;
  EXPECT_NE(both.err.find("is in units of 0.01 m, and measured in 1 m"), std::string::npos) << both.err;
  EXPECT_NEAR(json::parse(both.out)["droop_mm"].get<double>(), 0, 1e-3);
  EXPECT_NEAR(json::parse(both.out)["core_elongation"].get<double>(), 1, 1e-5);

  // An animation of ours is a groom as well, and a USD file of others no animation.
  ASSERT_EQ(
      runProgram(folder_, {"simulate", "metres.usda", "--backend", "reference", "--frames", "3", "-o", "out"})
          .exitCode,
      0);
  EXPECT_EQ(jsonOf(folder_, {"measure", "metres.usda", "out"})["frames"], 3);
  EXPECT_EQ(jsonOf(folder_, {"measure", "out/hair.usda", "out"})["frames"], 3);
  const json first = jsonOf(folder_, {"measure", "out/hair.usda"});
  EXPECT_EQ(first["frames"], 0);
  EXPECT_EQ(first["strands"], 2);
}

TEST_F(UsdGroom, IsConverted) {
  const json out = jsonOf(folder_, {"convert", "crate.usdc", "a.hair"});
  EXPECT_EQ(out["strands"], 2);
  EXPECT_EQ(out["particles"], 5);
  ASSERT_EQ(out["warnings"].size(), 2u) << out["warnings"];
  EXPECT_NE(out["warnings"].dump().find("turned from Z up"), std::string::npos) << out["warnings"];
  EXPECT_NE(out["warnings"].dump().find("a.hair does not hold its unit"), std::string::npos)
      << out["warnings"];
  EXPECT_EQ(readGroom(folder_ / "a.hair")->groom.points, readGroom(folder_ / "crate.usdc")->groom.points);
  const ProgramResult text = runProgram(folder_, {"convert", "plain.usda", "b.obj"});
  EXPECT_EQ(text.exitCode, 0) << text.err;
  EXPECT_NE(text.out.find("a groom of 2 strands, 10 particles, in units of 0.01 m"), std::string::npos)
      << text.out;
  struct Case {
    std::vector<std::string> arguments;
    int exitCode;
    const char* part;
  };
  for (const Case& c : {Case{{"plain.usda", "c.rgc"}, 1, "supported are .hair, .obj, .ply, .abc, "},
                        Case{{"plain.usda"}, 2, "name the file to write"},
                        Case{{"plain.usda", "c.obj", "--frame", "1"}, 2, "a groom has no frames"},
                        Case{{"plain.usda", "--info"}, 1, "`ringlet info`"}}) {
    auto arguments = c.arguments;
    arguments.insert(arguments.begin(), "convert");
    const ProgramResult result = runProgram(folder_, arguments);
    EXPECT_EQ(result.exitCode, c.exitCode) << result.err;
    EXPECT_NE(result.err.find(c.part), std::string::npos) << c.part << " in\n" << result.err;
  }
}

}  // namespace
}  // namespace ringlet::info_test
