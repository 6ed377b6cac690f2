// Runs whose numbers change: the bits of a run with those numbers where keys do not move them, what they do
// where they do, on the device as on the reference.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/program/run_program.h"
#include "tests/support/test_support.h"

namespace ringlet::test::scene_keys_test {
namespace {

using nlohmann::json;

class SceneKeysProgram : public testing::Test {
 protected:
  void SetUp() override {
    RINGLET_NEEDS_DEVICE(folder_);
    ASSERT_EQ(runProgram(folder_, {"make", "head", "--strands", "12", "--particles", "24", "-o", "head.obj"})
                  .exitCode,
              0);
  }

  // The run's JSON, with `droop_mm` of its last frame.
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

  std::filesystem::path folder_ = scratchFolder("scene_keys");
};

TEST_F(SceneKeysProgram, ThatDoNotMoveAreTheNumbersThemselves) {
  const json stated =
      run("steps_per_frame = 8\n[motion]\nkind = \"shake\"\n[material]\nbend_stiffness = "
          "7\n[material.dials]\nbounce = 2\n"
          "[air]\nwind = [1, 0, 2]\n[goal]\nstrength = 0.5\n");
  const json keyed = run(
      "steps_per_frame = 8\n[motion]\nkind = \"shake\"\n[[key]]\ntime = 0.2\nair.wind = [1, 0, 2]\n"
      "material.bend_stiffness = 7\n[[key]]\ntime = 0.9\nmaterial.dials.bounce = 2\ngoal.strength = 0.5\n");
  EXPECT_EQ(stated["positions_hash"], keyed["positions_hash"]);
}

// Held, then let go under four times its weight; on the device as on the reference, and step by step.
TEST_F(SceneKeysProgram, ThatMoveAreFelt) {
  const std::string keys =
      "[[key]]\ntime = 0\nmaterial.dials.weight = 4\ngoal.strength = 1000\n[[key]]\ntime = "
      "0.5\ngoal.strength = 1000\n"
      "[[key]]\ntime = 0.51\ngoal.strength = 0\n";
  const json held = run("[material.dials]\nweight = 4\n[goal]\nstrength = 1000\n");
  const json device = run(keys), reference = run(keys, {"--backend", "reference"}),
             watched = run(keys, {"--measure-contacts"});
  EXPECT_LT(std::abs(held["droop_mm"].get<double>()), 1);
  EXPECT_GT(device["droop_mm"], 10);
  EXPECT_NEAR(device["droop_mm"].get<double>(), reference["droop_mm"].get<double>(), 0.05);
  EXPECT_NEAR(device["droop_mm"].get<double>(), watched["droop_mm"].get<double>(), 0.05);
}

TEST_F(SceneKeysProgram, OfContactsAreForTheDevice) {
  std::ofstream(folder_ / "scene.toml")
      << "[groom]\nfile = \"head.obj\"\n[simulation]\nframes = 3\n[contacts]\n"
         "[[key]]\ntime = 0\ncontacts.friction = 0.1\n";
  const auto refused = runProgram(folder_, {"simulate", "scene.toml", "-o", "out", "--backend", "reference"});
  EXPECT_EQ(refused.exitCode, 1);
  EXPECT_NE(refused.err.find("numbers of contacts change over time on the GPU only"), std::string::npos)
      << refused.err;
  EXPECT_EQ(runProgram(folder_, {"simulate", "scene.toml", "-o", "other"}).exitCode, 0);
}

}  // namespace
}  // namespace ringlet::test::scene_keys_test
