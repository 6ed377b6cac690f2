// `ringlet material`, and the options by which `ringlet simulate` chooses it.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "ringlet/rest/material_file.h"
#include "ringlet/rest/material_parameters.h"
#include "ringlet/rest/material_presets.h"
#include "tests/program/run_program.h"
#include "tests/support/test_support.h"

namespace ringlet::material_test {
namespace {

using nlohmann::json;
using test::runProgram;
using test::scratchFolder;

void expectContains(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << "'" << part << "' is missing in:\n" << text;
}

// A curl of two turns, a few centimetres long.
void writeCurl(const std::filesystem::path& folder) {
  const auto made = runProgram(folder, {"make", "curl", "--turns", "2", "--length", "0.1", "--particles",
                                        "16", "--quiet", "-o", "curl.obj"});
  ASSERT_EQ(made.exitCode, 0) << made.err;
}

json simulate(const std::filesystem::path& folder, std::vector<std::string> options) {
  std::vector<std::string> arguments{"simulate", "curl.obj",  "--frames",  "4",           "--preload", "0",
                                     "--json",   "--backend", "reference", "--overwrite", "-o",        "out"};
  arguments.insert(arguments.end(), options.begin(), options.end());
  const auto result = runProgram(folder, arguments);
  EXPECT_EQ(result.exitCode, 0) << result.err;
  return json::parse(result.out, nullptr, false);
}

TEST(MaterialCommand, ListsPresetsAndParameters) {
  const auto folder = scratchFolder("material_list");
  const auto text = runProgram(folder, {"material", "--list"});
  EXPECT_EQ(text.exitCode, 0);
  EXPECT_EQ(text.err, "");
  const auto result = runProgram(folder, {"material", "--list", "--json"});
  const json out = json::parse(result.out, nullptr, false);
  ASSERT_TRUE(out.is_object()) << result.out;
  ASSERT_EQ(out["presets"].size(), presetNames().size());
  for (std::size_t i = 0; i < presetNames().size(); ++i) {
    EXPECT_EQ(out["presets"][i]["name"], presetNames()[i]);
    expectContains(text.out, presetNames()[i]);
    expectContains(text.out, presetSummary(presetNames()[i]));
  }
  auto expectTable = [&](const char* table, const auto& parameters) {
    ASSERT_EQ(out[table].size(), parameters.size()) << table;
    for (std::size_t i = 0; i < parameters.size(); ++i) {
      const json& row = out[table][i];
      EXPECT_EQ(row["key"], parameters[i].key);
      EXPECT_EQ(row["unit"], parameters[i].unit);
      EXPECT_EQ(row["effect"], parameters[i].effect);
      EXPECT_EQ(row["low"], parameters[i].allowed.low);
      EXPECT_EQ(row["usual_high"], parameters[i].usual.high);
      EXPECT_TRUE(row.contains("default"));
      EXPECT_FALSE(row.contains("value"));
      expectContains(text.out, parameters[i].key);
      expectContains(text.out, parameters[i].effect);
      expectContains(text.out, rangeText(parameters[i].allowed, parameters[i].unit));
    }
  };
  expectTable("parameters", materialParameters());
  expectTable("dials", dialParameters());
  expectTable("variation", variationParameters());
  expectTable("profile", profileParameters());
}

TEST(MaterialCommand, ShowsAPresetWithItsNumbers) {
  const auto folder = scratchFolder("material_show");
  const auto text = runProgram(folder, {"material", "coil"});
  EXPECT_EQ(text.exitCode, 0);
  EXPECT_EQ(text.err, "");
  expectContains(text.out, "coil: " + presetSummary("coil"));
  expectContains(text.out, "bend_stiffness         10 w");
  const json out = json::parse(runProgram(folder, {"material", "coil", "--json"}).out, nullptr, false);
  ASSERT_TRUE(out.is_object());
  EXPECT_EQ(out["name"], "coil");
  EXPECT_EQ(out["summary"], presetSummary("coil"));
  const Material coil = materialPreset("coil").value();
  for (std::size_t i = 0; i < materialParameters().size(); ++i) {
    const auto value = materialParameters()[i].of(coil);
    EXPECT_EQ(out["parameters"][i]["value"], value ? json(*value) : json(nullptr));
  }
  EXPECT_EQ(out["warnings"], json::array());
}

TEST(MaterialCommand, WritesAFileThatReadsBackTheSame) {
  const auto folder = scratchFolder("material_write");
  const auto result = runProgram(folder, {"material", "ringlet", "-o", "soft.toml"});
  EXPECT_EQ(result.exitCode, 0) << result.err;
  EXPECT_EQ(result.out, "ringlet: soft.toml\n");
  const auto loaded = readMaterial(folder / "soft.toml");
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_EQ(loaded->material, materialPreset("ringlet"));
  EXPECT_EQ(runProgram(folder, {"material", "soft.toml", "-o", "again.toml"}).exitCode, 0);
  EXPECT_EQ(test::readText(folder / "again.toml"), test::readText(folder / "soft.toml"));
}

TEST(MaterialCommand, MistakesAreOneSentence) {
  const auto folder = scratchFolder("material_mistakes");
  std::ofstream(folder / "broken.toml") << "preset = 'ringlet'\nbend_stifness = 5\n";
  std::ofstream(folder / "tail.toml") << "[profile]\nbend_stiffness = []\ngravity_factor = 5\n";
  std::ofstream(folder / "odd.toml") << "bend_damping_ratio = 0.01\n";
  struct Case {
    std::vector<std::string> arguments;
    int exitCode;
    std::string message;
  };
  for (const Case& c : {
           Case{{"material"}, 2, "name a preset or a .toml file, or use --list"},
           Case{{"material", "--list", "coil"}, 2, "leave out the name"},
           Case{{"material", "--list", "-o", "x.toml"}, 2, "only one material can be written"},
           Case{{"material", "ringlte"}, 2, "did you mean ringlet?"},
           Case{{"material", "coil", "-o", "x.txt"}, 2, "must end in .toml"},
           Case{{"material", "none.toml"}, 4, "none.toml"},
           Case{{"material", "broken.toml"},
                1,
                "broken.toml: line 2: found the unknown key 'bend_stifness'; "
                "did you mean bend_stiffness?"},
           Case{{"material", "coil", "-o", "none/x.toml"}, 5, "none/x.toml"},
           Case{{"material", "tail.toml"},
                1,
                "line 3: found the unknown key 'gravity_factor' in [profile]; "
                "did you mean gravity_factor, which stands above all tables?"},
           Case{{"simulate", "curl.obj", "-o", "out", "--material", "curly"},
                2,
                "there is no material 'curly'"},
           Case{{"simulate", "curl.obj", "-o", "out", "--hold", "0"}, 2, "from 0.001 to 1000"},
           Case{
               {"simulate", "curl.obj", "-o", "out", "--integrator", "paper", "--hold", "2"},
               2,
               "--hold: --integrator paper has spring constants of its own, which this dial does not change"},
       }) {
    const auto result = runProgram(folder, c.arguments);
    EXPECT_EQ(result.exitCode, c.exitCode) << result.err;
    EXPECT_EQ(result.out, "");
    expectContains(result.err, c.message);
  }
  const auto odd = runProgram(folder, {"material", "odd.toml"});
  EXPECT_EQ(odd.exitCode, 0);
  expectContains(odd.err, "ringlet material: warning: odd.toml: bend_damping_ratio is 0.01; usual is");
}

TEST(SimulateMaterial, ABrokenFileIsFoundBeforeAnythingIsWritten) {
  const auto folder = scratchFolder("simulate_broken_material");
  writeCurl(folder);
  std::ofstream(folder / "broken.toml") << "bend_stiffness = 'soft'\n";
  const auto result = runProgram(folder, {"simulate", "curl.obj", "--material", "broken.toml", "-o", "out"});
  EXPECT_EQ(result.exitCode, 1);
  expectContains(result.err,
                 "ringlet simulate: broken.toml: line 1: found the text 'soft' for bend_stiffness");
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}

// The same motion comes from the same numbers, whichever way they are given, and another from others.
TEST(SimulateMaterial, NumbersReachTheHair) {
  const auto folder = scratchFolder("simulate_material");
  writeCurl(folder);
  auto hash = [&](const std::vector<std::string>& options) {
    return simulate(folder, options)["positions_hash"].get<std::string>();
  };
  const std::string plain = hash({}), coil = hash({"--material", "coil"});
  EXPECT_NE(coil, plain);
  EXPECT_EQ(simulate(folder, {})["material"], "default");
  EXPECT_EQ(simulate(folder, {"--material", "coil"})["material"], "coil");

  // Files: a preset by name, all its numbers, and the default.
  std::ofstream(folder / "same.toml") << "preset = 'coil'\n";
  std::ofstream(folder / "empty.toml") << "";
  ASSERT_EQ(runProgram(folder, {"material", "coil", "-o", "all.toml"}).exitCode, 0);
  EXPECT_EQ(hash({"--material", "same.toml"}), coil);
  EXPECT_EQ(hash({"--material", "all.toml"}), coil);
  EXPECT_EQ(hash({"--material", "empty.toml"}), plain);

  // Dials: on the command line, in a file, and as the number they change; the command line wins.
  std::ofstream(folder / "dial.toml") << "[dials]\nhold = 4\n";
  std::ofstream(folder / "number.toml") << "bend_stiffness = 20\nbend_damping_ratio = 0.1\n";
  const std::string held = hash({"--hold", "4"});
  EXPECT_NE(held, plain);
  EXPECT_EQ(hash({"--material", "dial.toml"}), held);
  EXPECT_EQ(hash({"--material", "number.toml"}), held);
  EXPECT_EQ(hash({"--material", "dial.toml", "--hold", "1"}), plain);
  for (const char* dial :
       {"--bounce", "--spring-back", "--curl-keep", "--weight", "--root-hold", "--tip-hold", "--wet"})
    EXPECT_NE(hash({dial, "0.9"}), plain) << dial;
}

TEST(SimulateMaterial, MaxStretchIsTheLimit) {
  const auto folder = scratchFolder("simulate_stretch");
  writeCurl(folder);
  auto longest = [&](const std::vector<std::string>& options) {
    return simulate(folder, options)["max_edge_stretch"].get<double>();
  };
  EXPECT_GT(longest({}), 1.001);
  EXPECT_NEAR(longest({"--max-stretch", "1"}), 1, 1e-6);
}

// Each dial that cannot act says so, and no other.
TEST(SimulateMaterial, DialsThatCannotActSaySo) {
  const auto folder = scratchFolder("simulate_idle_dials");
  writeCurl(folder);
  std::ofstream(folder / "straight.obj") << "v 0 0 0\nv 0 -1 0\nv 0 -2 0\nv 0 -3 0\nl 1 2 3 4\n";
  const struct {
    std::vector<std::string> idle, acting;
    const char* sentence;
  } kCases[] = {
      {{"curl.obj", "--bounce", "2", "--motion", "nod"}, {"curl.obj", "--bounce", "2"}, "does not travel"},
      {{"curl.obj", "--weight", "2", "--gravity", "0"}, {"curl.obj", "--weight", "2"}, "there is no gravity"},
      {{"straight.obj", "--curl-keep", "2"},
       {"curl.obj", "--curl-keep", "2"},
       "no strand of the groom is curled"},
  };
  for (const auto& c : kCases) {
    const auto warningsOf = [&](std::vector<std::string> arguments) {
      arguments.insert(arguments.begin(), "simulate");
      for (const char* more :
           {"--frames", "3", "--backend", "reference", "--json", "-o", "idle", "--overwrite"})
        arguments.emplace_back(more);
      const auto result = runProgram(folder, arguments);
      EXPECT_EQ(result.exitCode, 0) << result.err;
      return json::parse(result.out)["warnings"];
    };
    const json idle = warningsOf(c.idle);
    ASSERT_EQ(idle.size(), 1u) << idle;
    expectContains(idle[0], c.sentence);
    EXPECT_EQ(warningsOf(c.acting), json::array()) << c.sentence;
  }
}

TEST(MaterialCommand, SuggestsWhatAGroomLooksLike) {
  const auto folder = scratchFolder("material_suggest");
  const struct {
    std::vector<std::string> groom;
    const char* preset;
  } kCases[] = {
      {{"make", "curl", "--radius", "0.004", "--turns", "20"}, "coil"},
      {{"make", "curl", "--radius", "0.01", "--turns", "8"}, "ringlet"},
      {{"make", "curl", "--radius", "0.02", "--turns", "4"}, "loose_curl"},
      {{"make", "curl", "--turns", "0"}, "straight"},
  };
  for (const auto& c : kCases) {
    std::vector<std::string> make = c.groom;
    for (const char* more : {"--particles", "128", "-o", "groom.obj"}) make.emplace_back(more);
    ASSERT_EQ(runProgram(folder, make).exitCode, 0) << c.preset;
    const auto result = runProgram(folder, {"material", "--suggest", "groom.obj", "--json"});
    ASSERT_EQ(result.exitCode, 0) << result.err;
    EXPECT_EQ(json::parse(result.out)["name"], c.preset) << result.err;
    expectContains(result.err, std::string("looks like ") + c.preset);
  }
  // A tenth of the size, another hair; and what cannot be read is said.
  ASSERT_EQ(
      runProgram(folder, {"make", "curl", "--radius", "0.02", "--turns", "4", "-o", "groom.obj"}).exitCode,
      0);
  const auto small = runProgram(folder, {"material", "--suggest", "groom.obj", "--unit", "0.001", "--json"});
  EXPECT_EQ(json::parse(small.out)["name"], "coil") << small.err;
  EXPECT_EQ(runProgram(folder, {"material", "--suggest", "none.obj"}).exitCode, 4);
  EXPECT_EQ(runProgram(folder, {"material", "coil", "--suggest", "groom.obj"}).exitCode, 2);
  EXPECT_EQ(runProgram(folder, {"material", "coil", "--unit", "1"}).exitCode, 2);
}

TEST(SimulateMaterial, WarningsAreSaid) {
  const auto folder = scratchFolder("simulate_material_warnings");
  writeCurl(folder);
  const json damped = simulate(folder, {"--spring-back", "0.5"});
  ASSERT_EQ(damped["warnings"].size(), 1u);
  expectContains(damped["warnings"][0], "a bend damping ratio of 0.075, below 0.1");
  const json paper = simulate(folder, {"--integrator", "paper", "--material", "coil"});
  ASSERT_GE(paper["warnings"].size(), 1u);
  expectContains(paper["warnings"][0], "the paper's integrator has spring constants of its own");
}

TEST(SimulateMaterial, DialsAreHeldToTheirRangesAsInAFile) {
  const auto folder = scratchFolder("simulate_dial_ranges");
  writeCurl(folder);
  const json unusual = simulate(folder, {"--hold", "20"});
  ASSERT_EQ(unusual["warnings"].size(), 1u);
  expectContains(unusual["warnings"][0], "dials.hold is 20; usual is from 0.1 to 10");

  // Of a file's own dial its reader has told already, by the file's name.
  std::ofstream(folder / "far.toml") << "[dials]\nhold = 20\n";
  const json file = simulate(folder, {"--material", "far.toml"});
  ASSERT_EQ(file["warnings"].size(), 1u);
  expectContains(file["warnings"][0], "far.toml: dials.hold is 20");

  // What becomes of a number is told with the dial that made it.
  const auto result = runProgram(folder, {"simulate", "curl.obj", "-o", "none", "--spring-back", "1000"});
  EXPECT_EQ(result.exitCode, 1);
  expectContains(result.err,
                 "bend_damping_ratio is 150; it must be from 0 to 100, with the dials worked in: "
                 "spring_back 1000");
  EXPECT_FALSE(std::filesystem::exists(folder / "none"));
}

TEST(SimulateMaterial, HelpNamesTheOptions) {
  const auto folder = scratchFolder("material_help");
  const std::string help = runProgram(folder, {"simulate", "--help"}).out;
  for (const char* part : {"--material", "--hold", "--bounce", "--spring-back", "--curl-keep", "--weight",
                           "--root-hold", "--tip-hold", "--wet", "--max-stretch"})
    expectContains(help, part);
  for (const auto& dial : dialParameters()) {
    expectContains(help, dial.effect);
    expectContains(help, rangeText(dial.allowed, dial.unit) + ", usual " + rangeText(dial.usual, dial.unit));
  }
  expectContains(runProgram(folder, {"material", "--help"}).out, "Example:");
}

}  // namespace
}  // namespace ringlet::material_test
