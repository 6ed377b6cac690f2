// Runs among force fields and with held hair: on the device as on the reference, and step by step.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/program/run_program.h"
#include "tests/support/test_support.h"

namespace ringlet::test::scene_forces_test {
namespace {

using nlohmann::json;

class SceneForcesProgram : public testing::Test {
 protected:
  void SetUp() override {
    RINGLET_NEEDS_DEVICE(folder_);
    ASSERT_EQ(runProgram(folder_, {"make", "head", "--strands", "12", "--particles", "24", "-o", "head.obj"})
                  .exitCode,
              0);
  }

  // The run's JSON, with what `measure` says of its last frame.
  json run(const std::string& scene, std::vector<std::string> more = {}) {
    std::ofstream(folder_ / "scene.toml") << "[groom]\nfile = \"head.obj\"\n[simulation]\nframes = 24\n"
                                          << scene;
    std::vector<std::string> arguments{"simulate", "scene.toml", "-o", "out", "--overwrite", "--json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const auto result = runProgram(folder_, arguments);
    EXPECT_EQ(result.exitCode, 0) << result.err;
    json out = json::parse(result.out, nullptr, false);
    const auto measured = runProgram(folder_, {"measure", "head.obj", "out", "--json"});
    EXPECT_EQ(measured.exitCode, 0) << measured.err;
    out["droop_mm"] = json::parse(measured.out, nullptr, false)["droop_mm"];
    return out;
  }
  static double droopOf(const json& run) { return run["droop_mm"].get<double>(); }

  std::filesystem::path folder_ = scratchFolder("scene_forces_program");
};

// A field along gravity is more gravity, but for what the rest pose balances.
TEST_F(SceneForcesProgram, AnEvenFieldIsWeight) {
  const json still = run(""), heavy = run("[[field]]\nkind = \"uniform\"\nstrength = -9.81\n"),
             weight = run("[material.dials]\nweight = 2\n");
  EXPECT_LT(std::abs(droopOf(still)), 1);
  EXPECT_GT(droopOf(heavy), 5);
  EXPECT_NEAR(droopOf(heavy), droopOf(weight), 0.01);
}

TEST_F(SceneForcesProgram, EveryKindAgreesWithTheReference) {
  const std::string fields[] = {"kind = \"uniform\"\nstrength = 9\naxis = [1, 0, 0]\nreach = 0.4\n",
                                "kind = \"point\"\nstrength = 9\nposition = [0.2, 0, 0]\n",
                                "kind = \"line\"\nstrength = -9\nbind = \"head\"\n",
                                "kind = \"vortex\"\nstrength = 2\ndrag = 8\n",
                                "kind = \"blast\"\nstrength = 90\nspeed = 2\n",
                                "kind = \"drag\"\nreach = 0.3\n"};
  for (const std::string& field : fields) {
    SCOPED_TRACE(field);
    const std::string scene = "[motion]\nkind = \"shake\"\n[[field]]\n" + field;
    const json device = run(scene), reference = run(scene, {"--backend", "reference"});
    EXPECT_NEAR(droopOf(device), droopOf(reference), 0.05);
    EXPECT_NE(device["positions_hash"], run("[motion]\nkind = \"shake\"\n")["positions_hash"]);
  }
}

// Step by step a front goes on within a frame.
TEST_F(SceneForcesProgram, FieldsMoveWithinFrames) {
  const std::string scene =
      "[[field]]\nkind = \"blast\"\nstrength = 3000\nstart = 0.9\nspeed = 4\nthickness = 0.05\n";
  const json frames = run(scene), steps = run(scene, {"--measure-contacts"});
  EXPECT_GT(std::abs(droopOf(frames)), 5);
  EXPECT_NEAR(droopOf(frames), droopOf(steps), 0.001 * std::abs(droopOf(frames)));
}

TEST_F(SceneForcesProgram, HeldHairIsLetGo) {
  const std::string falls = "[[field]]\nkind = \"uniform\"\nstrength = -30\n";
  const std::string hold = "[[hold]]\nbegin = 0\nend = 1\nstrength = 1000\n";
  const json held = run(falls + hold), released = run(falls + hold + "release = 0.5\n"), never = run(falls);
  EXPECT_LT(std::abs(droopOf(held)), 1);
  EXPECT_GT(droopOf(released), 10);
  EXPECT_GT(droopOf(never), 10);
  const std::string scene = "[motion]\nkind = \"shake\"\n" + falls + hold + "gather = 0.5\nrelease = 0.5\n";
  const json device = run(scene), reference = run(scene, {"--backend", "reference"}),
             watched = run(scene, {"--measure-contacts"});
  EXPECT_NEAR(droopOf(device), droopOf(reference), 0.05);
  EXPECT_NEAR(droopOf(device), droopOf(watched), 0.05);
}

// An animation as goal: what hair did in another run it does again under other forces, however many steps.
TEST_F(SceneForcesProgram, AnAnimationIsFollowed) {
  const std::string motion = "[motion]\nkind = \"walk\"\n";
  std::ofstream(folder_ / "first.toml") << "[groom]\nfile = \"head.obj\"\n[simulation]\nframes = 24\n"
                                        << motion;
  ASSERT_EQ(runProgram(folder_, {"simulate", "first.toml", "-o", "first", "--cache", "float32"}).exitCode, 0);
  for (const char* file : {"first/hair.rgc", "first/hair.usda"}) {
    const std::string scene = "steps_per_frame = 16\n" + motion + "[goal]\nstrength = 1e6\nfile = \"" + file +
                              "\"\n[[field]]\nkind = \"uniform\"\nstrength = 20\naxis = [1, 0, 0]\n";
    const json device = run(scene);
    const auto compared = runProgram(folder_, {"measure", "head.obj", "first", "--json"});
    const double first = json::parse(compared.out, nullptr, false)["droop_mm"];
    EXPECT_NEAR(droopOf(device), first, 0.05) << file;
    EXPECT_GT(std::abs(droopOf(device) - droopOf(run(motion + "[goal]\nstrength = 1e6\n"))), 0.05);
    EXPECT_NEAR(droopOf(device), droopOf(run(scene, {"--backend", "reference"})), 0.05);
  }
}

}  // namespace
}  // namespace ringlet::test::scene_forces_test
