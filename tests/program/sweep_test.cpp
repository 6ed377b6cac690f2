// `ringlet sweep`: runs with the bits of `ringlet simulate`, what is kept of them, what is refused.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/motion/gltf_samples.h"
#include "tests/program/run_program.h"
#include "tests/support/test_support.h"

namespace ringlet::sweep_test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::readText;
using test::runProgram;
using test::scratchFolder;

class Sweep : public testing::Test {
 protected:
  void SetUp() override {
    std::ofstream(folder_ / "scene.toml")
        << "[groom]\ngenerate = 'swatch'\ncolumns = 3\nrows = 1\nparticles = 16\nturns = 3\n"
           "[material]\npreset = 'wavy'\n[motion]\nkind = 'shake'\n"
           "[simulation]\nframes = 3\nsteps_per_frame = 2\n";
  }

  test::ProgramResult sweep(std::vector<std::string> vary, std::vector<std::string> more = {}) const {
    std::vector<std::string> arguments{"sweep", "scene.toml", "-o", "out"};
    for (std::string& axis : vary) arguments.insert(arguments.end(), {"--vary", std::move(axis)});
    arguments.insert(arguments.end(), more.begin(), more.end());
    return runProgram(folder_, arguments);
  }
  // Without a device: what a sweep keeps and refuses has nothing to do with it.
  test::ProgramResult onCpu(std::vector<std::string> vary, std::vector<std::string> more = {}) const {
    more.insert(more.end(), {"--backend", "reference"});
    return sweep(std::move(vary), std::move(more));
  }

  std::vector<std::string> states() const {
    std::vector<std::string> all;
    const json table = json::parse(readText(folder_ / "out/sweep.json"));
    for (const json& run : table["runs"]) all.push_back(run["state"]);
    return all;
  }
  std::string hashIn(const std::string& run) const {
    return json::parse(readText(folder_ / "out" / run / "run.json"))["positions_hash"];
  }

  fs::path folder_ = scratchFolder("sweep");
  using States = std::vector<std::string>;
};

// Each kind of key: what is live, what makes another groom, other steps, other bodies.
TEST_F(Sweep, EachRunHasTheBitsOfSimulate) {
  RINGLET_NEEDS_DEVICE(folder_);
  struct Axis {
    const char* key;
    std::vector<std::string> values;
    const char* file;  // the line of a scene file, {} the value; none: the scene that the run wrote down
    const char* more;  // of the scene
  };
  const std::vector<Axis> axes = {
      {"material.dials.hold", {"0.5", "2"}, "[material.dials]\nhold = {}\n", ""},
      {"material.preset", {"coil", "straight"}, nullptr, ""},
      {"groom.particles", {"12", "24"}, nullptr, ""},
      {"simulation.steps_per_frame", {"2", "5"}, nullptr, ""},
      {"body.1.radius", {"0.01", "0.2"}, nullptr, "[[body]]\nshape = 'sphere'\nposition = [0, -0.3, 0]\n"},
  };
  const std::string base = readText(folder_ / "scene.toml");
  for (const Axis& axis : axes) {
    fs::remove_all(folder_ / "out");
    std::ofstream(folder_ / "scene.toml") << base << axis.more;
    const auto result =
        sweep({fmt::format("{}={},{}", axis.key, axis.values[0], axis.values[1])}, {"--json"});
    ASSERT_EQ(result.exitCode, 0) << axis.key << result.err;
    const json runs = json::parse(result.out)["runs"];
    EXPECT_NE(runs[0]["positions_hash"], runs[1]["positions_hash"]) << axis.key << " changes nothing";
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_EQ(runs[i]["values"][axis.key], axis.values[i]);
      const std::string folder = runs[i]["folder"];
      std::string scene = folder + "/scene.toml";
      if (axis.file) {
        scene = "changed.toml";
        std::ofstream(folder_ / scene) << base << fmt::format(fmt::runtime(axis.file), axis.values[i]);
      }
      const auto alone = runProgram(folder_, {"simulate", scene, "--json", "--overwrite", "-o", "alone"});
      ASSERT_EQ(alone.exitCode, 0) << scene << alone.err;
      EXPECT_EQ(json::parse(alone.out)["positions_hash"], runs[i]["positions_hash"]) << axis.key;
      for (const char* file : {"hair.usda", "last.obj", "sheet.png"})
        EXPECT_EQ(readText(folder_ / folder / file), readText(folder_ / "alone" / file)) << axis.key << file;
    }
  }
}

TEST_F(Sweep, ValuesAreNumbersTextsAndLists) {
  struct Case {
    const char* axis;
    std::vector<std::string> values;
  };
  const std::vector<Case> cases = {
      {"simulation.gravity=0:9:4", {"0", "3", "6", "9"}},
      {"simulation.gravity=9.81:5:2", {"9.81", "5"}},
      {"simulation.gravity=3:5:1", {"3"}},
      {"groom.particles=16,32", {"16", "32"}},
      {"material.preset=wavy,\"coil\"", {"wavy", "\"coil\""}},
      {"air.wind=[0,0,0],[3,0,1]", {"[0,0,0]", "[3,0,1]"}},
      {"contacts.on=true,false", {"true", "false"}},
  };
  for (const Case& c : cases) {
    const auto result = onCpu({c.axis}, {"--list", "--json"});
    ASSERT_EQ(result.exitCode, 0) << c.axis << result.err;
    const json listed = json::parse(result.out);
    std::vector<std::string> values;
    for (const json& run : listed["runs"]) values.push_back(run["values"].front());
    EXPECT_EQ(values, c.values) << c.axis;
    EXPECT_FALSE(fs::exists(folder_ / "out")) << "a list makes nothing";
  }
}

TEST_F(Sweep, RunsAreAllCombinationsAndTheirTableIsThere) {
  const auto result =
      onCpu({"material.dials.hold=0.5:2:3", "simulation.gravity=5,9.81"}, {"--json", "--last-only"});
  ASSERT_EQ(result.exitCode, 0) << result.err;
  const json runs = json::parse(result.out)["runs"];
  ASSERT_EQ(runs.size(), 6u);
  const std::vector<std::pair<std::string, std::string>> expected = {
      {"0.5", "5"}, {"0.5", "9.81"}, {"1.25", "5"}, {"1.25", "9.81"}, {"2", "5"}, {"2", "9.81"}};
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(runs[i]["values"]["material.dials.hold"], expected[i].first);
    EXPECT_EQ(runs[i]["values"]["simulation.gravity"], expected[i].second);
    EXPECT_EQ(runs[i]["frames"], 3);
    EXPECT_FALSE(fs::exists(folder_ / runs[i]["folder"].get<std::string>() / "hair.usda"));
    EXPECT_TRUE(fs::exists(folder_ / runs[i]["folder"].get<std::string>() / "last.obj"));
  }
  for (const char* number : {"droop_mm", "stretch_mean", "stretch_max", "max_edge_stretch", "seconds"})
    EXPECT_TRUE(runs[5][number].is_number()) << number;
  EXPECT_EQ(json::parse(readText(folder_ / "out/sweep.json")), json::parse(result.out));

  const std::string csv = readText(folder_ / "out/sweep.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 7);
  EXPECT_TRUE(csv.starts_with("run,state,exit_status,material.dials.hold,simulation.gravity,frames,")) << csv;
  EXPECT_NE(csv.find("\n4,finished,0,1.25,9.81,3,"), std::string::npos) << csv;

  // A row of the picture is of one hold: two cells of 240 x 320 pixels across, three down.
  const std::string png = readText(folder_ / "out/sheet.png");
  const auto number = [&](std::size_t at) {
    return static_cast<unsigned char>(png[at + 2]) * 256 + static_cast<unsigned char>(png[at + 3]);
  };
  ASSERT_GT(png.size(), 24u);
  EXPECT_EQ(number(16), 2 * 240);
  EXPECT_EQ(number(20), 3 * 320);
}

TEST_F(Sweep, FinishedRunsAreKeptAndOthersAreRun) {
  const std::vector<std::string> vary{"material.dials.hold=0.5,1,2"};
  ASSERT_EQ(onCpu(vary).exitCode, 0);
  EXPECT_EQ(states(), (States{"finished", "finished", "finished"}));
  const std::string hash = hashIn("run-0002"), csv = readText(folder_ / "out/sweep.csv");
  fs::remove(folder_ / "out/run-0002/run.json");
  // What a run leaves that was killed: the sweep knows its own.
  std::ofstream(folder_ / "out/run-0002/hair.usda.partial") << "#usda 1.0\n";
  ASSERT_EQ(onCpu(vary).exitCode, 0);
  EXPECT_EQ(states(), (States{"kept", "finished", "kept"}));
  EXPECT_EQ(hashIn("run-0002"), hash);
  ASSERT_EQ(onCpu(vary, {"--overwrite"}).exitCode, 0);
  EXPECT_EQ(states(), (States{"finished", "finished", "finished"}));
}

// A glTF file's motion is in a file that it names.
TEST_F(Sweep, ARunIsNotKeptWhereABufferChanged) {
  test::GltfBuilder gltf;
  const int head = gltf.node({{"name", "Head"}});
  gltf.channel(0, head, "translation", "LINEAR", {0, 0.0625, 0.125}, {0, 0, 0, 0.05, 0, 0, 0, 0, 0});
  std::ofstream(folder_ / "m.gltf") << gltf.textBeside("m.bin");
  std::string bytes = gltf.bytes();
  std::ofstream(folder_ / "m.bin", std::ios::binary) << bytes;
  std::string scene = readText(folder_ / "scene.toml");
  scene.replace(scene.find("kind = 'shake'"), 14, "file = 'm.gltf'");
  std::ofstream(folder_ / "scene.toml") << scene;
  const std::vector<std::string> vary{"material.dials.hold=1,2"};
  const auto first = onCpu(vary);
  ASSERT_EQ(first.exitCode, 0) << first.err;
  const std::string hash = hashIn("run-0001");
  ASSERT_EQ(onCpu(vary).exitCode, 0);
  EXPECT_EQ(states(), (States{"kept", "kept"}));
  const float place = 0.03f;  // in place of 0.05, two points of 12 bytes before the end
  std::memcpy(&bytes[bytes.size() - 24], &place, sizeof place);
  std::ofstream(folder_ / "m.bin", std::ios::binary) << bytes;
  const auto other = onCpu(vary);
  EXPECT_EQ(other.exitCode, 4);
  EXPECT_NE(other.err.find("m.bin"), std::string::npos) << other.err;
  EXPECT_EQ(hashIn("run-0001"), hash);
  ASSERT_EQ(onCpu(vary, {"--overwrite"}).exitCode, 0);
  EXPECT_EQ(states(), (States{"finished", "finished"}));
  EXPECT_NE(hashIn("run-0001"), hash);
}

// A run that is kept counts as it did when it was made.
TEST_F(Sweep, WhatHasNoPositionIsToldAgain) {
  const std::vector<std::string> vary{"simulation.integrator=jacobi,paper", "simulation.steps_per_frame=1",
                                      "simulation.frames=30"};
  const auto first = onCpu(vary);
  EXPECT_EQ(first.exitCode, 3) << first.err;  // the paper's is explicit, and a step too long for it
  const json run = json::parse(readText(folder_ / "out/run-0002/run.json"));
  EXPECT_GT(run["nonfinite"], 0);
  EXPECT_EQ(states(), (States{"finished", "finished"}));
  const auto again = onCpu(vary);
  EXPECT_EQ(again.exitCode, 3) << again.err;
  EXPECT_EQ(states(), (States{"kept", "kept"}));
  EXPECT_NE(readText(folder_ / "out/sweep.csv").find("\n2,kept,3,"), std::string::npos)
      << readText(folder_ / "out/sweep.csv");
}

// Every path of a scene, from another folder than that in which the sweep was started.
TEST_F(Sweep, ARunsSceneIsRunAgainFromAnywhere) {
  const fs::path made = scratchFolder("sweep_paths");
  fs::create_directory(made / "files");
  ASSERT_EQ(runProgram(made, {"make", "swatch", "--columns", "3", "--rows", "1", "--particles", "16", "-o",
                              "files/groom.obj"})
                .exitCode,
            0);
  std::ofstream(made / "files/ball.obj") << "v 0.02 -0.3 0\nv -0.02 -0.3 0\nv 0 -0.27 0.03\nv 0 -0.3 -0.03\n"
                                            "f 1 3 2\nf 1 4 3\nf 2 3 4\nf 1 2 4\n";
  std::ofstream(made / "files/scalp.obj") << "v -50 0 -50\nv 50 0 -50\nv 0 0 90\nf 1 3 2\n";
  std::ofstream(made / "files/map.txt") << "0,1\n1,0.5\n2,2\n";
  std::ofstream(made / "files/m.bvh")
      << "HIERARCHY\nROOT Head\n{\nOFFSET 0 0 0\nCHANNELS 3 Zrotation Xrotation Yrotation\nEnd Site\n{\n"
         "OFFSET 0 170 0\n}\n}\nMOTION\nFrames: 4\nFrame Time: 0.04\n0 0 0\n0 4 0\n0 9 0\n0 9 0\n";
  std::ofstream(made / "scene.toml")
      << "[groom]\nfile = 'files/groom.obj'\n[motion]\nfile = 'files/m.bvh'\nunit = 0.01\n"
         "[goal]\nfile = 'files/groom.obj'\n[[body]]\nname = 'ball'\nshape = 'mesh'\nfile = "
         "'files/ball.obj'\n"
         "unit = 1\ncells = 8\n[body.moves]\nfile = 'files/m.bvh'\nunit = 0.01\n"
         "[[map]]\nnumber = 'bend_stiffness'\nfile = 'files/map.txt'\n[simulation]\nframes = "
         "3\nsteps_per_frame = "
         "4\n"
         "[output]\nhairs = 9\nhair_scalp_file = 'files/scalp.obj'\n";
  const auto swept = runProgram(made, {"sweep", "scene.toml", "--vary", "material.dials.hold=1,2",
                                       "--backend", "reference", "-o", "out", "--no-sheet"});
  ASSERT_EQ(swept.exitCode, 0) << swept.err;
  const json expected = json::parse(readText(made / "out/run-0002/run.json"))["positions_hash"];
  const fs::path elsewhere = scratchFolder("sweep_paths_elsewhere");
  const auto again = runProgram(elsewhere, {"simulate", (made / "out/run-0002/scene.toml").string(),
                                            "--backend", "reference", "--json", "-o", "again"});
  ASSERT_EQ(again.exitCode, 0) << again.err;
  EXPECT_EQ(json::parse(again.out)["positions_hash"], expected);
}

// What was in a run's folder before the sweep stays, however often it is tried.
TEST_F(Sweep, FilesOfOthersAreNotReplaced) {
  fs::create_directories(folder_ / "out/run-0001");
  std::ofstream(folder_ / "out/run-0001/last.obj") << "mine";
  for (int k = 0; k < 2; ++k) {
    const auto refused = onCpu({"material.dials.hold=1,2"});
    EXPECT_EQ(refused.exitCode, 5);
    EXPECT_NE(refused.err.find("holds a run's files: last.obj"), std::string::npos) << refused.err;
    EXPECT_EQ(readText(folder_ / "out/run-0001/last.obj"), "mine");
    EXPECT_EQ(states(), (States{"failed", k == 0 ? "finished" : "kept"}));
  }
}

TEST_F(Sweep, AFolderOfSomethingElseIsRefused) {
  std::ofstream(folder_ / "groom.obj") << "v 0 0 0\nv 0 -10 0\nv 10 -10 0\nl 1 2 3\n";
  std::ofstream(folder_ / "scene.toml") << "[groom]\nfile = 'groom.obj'\n[simulation]\nframes = 2\n";
  const std::vector<std::string> vary{"material.dials.hold=0.5,2"};
  ASSERT_EQ(onCpu(vary).exitCode, 0);
  const auto expectRefused = [&](const test::ProgramResult& result, const std::string& reason) {
    EXPECT_EQ(result.exitCode, 4);
    EXPECT_NE(result.err.find(reason), std::string::npos) << result.err;
    EXPECT_NE(result.err.find("--overwrite"), std::string::npos) << result.err;
  };
  expectRefused(onCpu({"material.dials.hold=0.5,3"}), "hold is 3");
  expectRefused(onCpu({"material.dials.hold=0.5,2", "simulation.gravity=4"}), "gravity is 4");
  expectRefused(onCpu(vary, {"--last-only"}), "hair.usda is false and was true");
  EXPECT_EQ(onCpu(vary).exitCode, 0) << "nothing was lost";
  EXPECT_EQ(states(), (States{"kept", "kept"}));
  std::ofstream(folder_ / "groom.obj") << "v 0 0 0\nv 0 -10 0\nv 11 -10 0\nl 1 2 3\n";
  expectRefused(onCpu(vary), "groom.obj");
  EXPECT_EQ(onCpu(vary, {"--overwrite"}).exitCode, 0);
}

TEST_F(Sweep, WhatUsdHoldsIsKeptApart) {
  const std::string files = "output.files=[\"hair.usdc\", \"last.obj\"]", vary = "material.dials.hold=1,2";
  ASSERT_EQ(onCpu({vary, files}, {"--last-only"}).exitCode, 0);
  EXPECT_FALSE(fs::exists(folder_ / "out/run-0001/hair.usdc")) << "--last-only";
  fs::remove_all(folder_ / "out");
  const auto whole = onCpu({vary, files});
  ASSERT_EQ(whole.exitCode, 0) << whole.err;
  EXPECT_TRUE(fs::exists(folder_ / "out/run-0001/hair.usdc"));
  const auto other = onCpu({vary, files, "output.tip_width=0.0001"});
  EXPECT_EQ(other.exitCode, 4);
  EXPECT_NE(other.err.find("tip_width"), std::string::npos) << other.err;
}

TEST_F(Sweep, ARunThatFailsDoesNotLoseTheOthers) {
  std::ofstream(folder_ / "groom.obj") << "v 0 0 0\nv 0 -10 0\nv 10 -10 0\nl 1 2 3\n";
  std::ofstream(folder_ / "scene.toml") << "[groom]\nfile = 'groom.obj'\n[simulation]\nframes = 2\n";
  const std::vector<std::string> vary{"groom.file=groom.obj,missing.obj", "simulation.gravity=5,9.81"};
  const auto result = onCpu(vary);
  EXPECT_EQ(result.exitCode, 4) << result.err;
  EXPECT_NE(result.err.find("missing.obj"), std::string::npos) << result.err;
  EXPECT_EQ(states(), (States{"finished", "finished", "failed", "failed"}));
  EXPECT_NE(readText(folder_ / "out/sweep.csv").find("\n3,failed,4,missing.obj,5,"), std::string::npos);
  // Once the file is there, what is missing is run.
  fs::copy(folder_ / "groom.obj", folder_ / "missing.obj");
  EXPECT_EQ(onCpu(vary).exitCode, 0);
  EXPECT_EQ(states(), (States{"kept", "kept", "finished", "finished"}));
}

TEST_F(Sweep, ALostDeviceLosesOneRun) {
  RINGLET_NEEDS_DEVICE(folder_);
  const std::vector<std::string> vary{"material.dials.hold=0.5,1,2", "simulation.frames=20"};
  setenv("VK_LAYER_PATH", RINGLET_LAYER_DIR, 1);
  setenv("VK_INSTANCE_LAYERS", "VK_LAYER_RINGLET_fault", 1);
  setenv("RINGLET_FAULT", "vkQueueSubmit:35:-4", 1);  // some way into the second run
  const auto failed = sweep(vary, {"--jobs", "1"});
  unsetenv("RINGLET_FAULT");
  unsetenv("VK_INSTANCE_LAYERS");
  unsetenv("VK_LAYER_PATH");
  EXPECT_EQ(failed.exitCode, 10) << failed.err;
  EXPECT_EQ(states(), (States{"finished", "failed", "finished"})) << "the third has a device opened anew";
  EXPECT_EQ(sweep(vary).exitCode, 0) << "what the failed run left is in nobody's way";
  EXPECT_EQ(states(), (States{"kept", "finished", "kept"}));
}

TEST_F(Sweep, AnInterruptionKeepsWhatIsFinished) {
  const auto arguments = [](const char* frames) {
    return std::vector<std::string>{"sweep",  "scene.toml", "-o",     "out", "--backend",  "reference",
                                    "--vary", frames,       "--jobs", "1",   "--no-sheet", "--last-only"};
  };
  test::RunningProgram running(folder_, arguments("simulation.frames=3,1000000"));
  ASSERT_TRUE(running.waitUntil([&] { return fs::exists(folder_ / "out/run-0001/run.json"); }));
  running.send(SIGINT);
  EXPECT_EQ(running.wait().exitCode, 130);
  EXPECT_EQ(states().front(), "finished");
  EXPECT_NE(states().back(), "finished");
  EXPECT_EQ(runProgram(folder_, arguments("simulation.frames=3,4")).exitCode, 0);
  EXPECT_EQ(states(), (States{"kept", "finished"}));
}

// Runs of one frame: the signal seldom finds one that it can cut short.
TEST_F(Sweep, AnInterruptionBetweenRunsIsOneToo) {
  for (int attempt = 0; attempt < 5; ++attempt) {
    fs::remove_all(folder_ / "out");
    test::RunningProgram running(folder_, {"sweep", "scene.toml", "-o", "out", "--backend", "reference",
                                           "--vary", "material.dials.hold=0.5:2:2000", "--vary",
                                           "simulation.frames=1", "--jobs", "1", "--no-sheet"});
    ASSERT_TRUE(running.waitUntil([&] { return fs::exists(folder_ / "out/run-0002/run.json"); }));
    running.send(SIGINT);
    const auto result = running.wait();
    ASSERT_EQ(states().back(), "to do") << "the signal came too late to say anything";
    EXPECT_EQ(result.exitCode, 130);
  }
}

TEST_F(Sweep, PartsAreAllRunsOnce) {
  const std::vector<std::string> vary{"material.dials.hold=0.5:2:5"};
  const std::vector<States> expected = {{"finished", "to do", "to do", "finished", "to do"},
                                        {"kept", "finished", "to do", "kept", "finished"},
                                        {"kept", "kept", "finished", "kept", "kept"}};
  for (std::size_t i = 0; i < 3; ++i) {
    ASSERT_EQ(onCpu(vary, {"--only", fmt::format("{}/3", i + 1)}).exitCode, 0);
    EXPECT_EQ(states(), expected[i]) << i;
  }
  for (const char* part : {"0/3", "4/3", "1", "a/b", "1/"})
    EXPECT_EQ(onCpu(vary, {"--only", part}).exitCode, 2) << part;
}

TEST_F(Sweep, ProgressIsALineOfJsonARunAndAFrame) {
  const auto result = onCpu({"material.dials.hold=0.5,2"}, {"--json-progress", "--quiet", "--jobs", "1"});
  ASSERT_EQ(result.exitCode, 0) << result.err;
  std::vector<json> lines;
  for (std::size_t at = 0; at < result.out.size(); at = result.out.find('\n', at) + 1)
    lines.push_back(json::parse(result.out.substr(at, result.out.find('\n', at) - at)));
  ASSERT_EQ(lines.size(), 8u) << result.out;  // three frames and the run, twice
  EXPECT_EQ(lines[0]["run"], 1);
  EXPECT_EQ(lines[0]["frame"], 1);
  EXPECT_EQ(lines[3]["state"], "finished");
  EXPECT_EQ(lines[7]["run"], 2);
  EXPECT_EQ(lines[7]["runs"], 2);
}

// Before anything runs, and nothing is made.
TEST_F(Sweep, WhatMakesNoSenseIsRefusedByName) {
  struct Case {
    std::vector<std::string> vary;
    int exitCode;
    const char* says;
  };
  const std::vector<Case> cases = {
      {{"material.dials.hould=1"}, 1, "did you mean material.dials.hold"},
      {{"simulation.gravitty=1,2"}, 1, "did you mean simulation.gravity"},
      {{"materiel.dials.hold=1"}, 1, "did you mean material"},
      {{"simulation.gravity=strong"}, 1, "the text 'strong' for simulation.gravity"},
      {{"groom.particles=16.5"}, 1, "expected a whole number"},
      {{"simulation.gravity.x=1"}, 1, "simulation.gravity.x"},
      {{"motion.key.2.time=1"}, 1, "motion.key.2.time"},
      {{"simulation..gravity=1"}, 1, "expected a key with its table"},
      {{"material.dials.hold=1", "material.dials.hold=2"}, 1, "varied twice"},
      {{"output.folder=a"}, 1, "output.folder"},
      {{"groom.seed=1:10001:10001"}, 1, "10000 at most"},
      {{"output.prims=groom"}, 2, "written into hair.usdc only"},  // hair.usda is what a scene writes
      {{"hold"}, 2, "KEY=a:b:n"},
      {{"=1"}, 2, "KEY=a:b:n"},
      {{"material.dials.hold="}, 2, "lacks a value"},
      {{"material.dials.hold=1,,2"}, 2, "lacks a value"},
      {{"material.dials.hold=1:2:0"}, 2, "lacks a value"},
  };
  for (const Case& c : cases) {
    const auto result = onCpu(c.vary);
    EXPECT_EQ(result.exitCode, c.exitCode) << c.vary[0] << result.err;
    EXPECT_NE(result.err.find(c.says), std::string::npos) << c.vary[0] << ": " << result.err;
    EXPECT_FALSE(fs::exists(folder_ / "out")) << c.vary[0];
  }
}

}  // namespace
}  // namespace ringlet::sweep_test
