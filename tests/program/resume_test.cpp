// Runs that do not end: killed, their disk full, their device lost. What --resume makes of them has the bits
// of a run without a break; folders belong to one run at a time, and what one leaves is not touched without
// being asked to.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "tests/program/run_program.h"
#include "tests/support/test_support.h"

namespace ringlet::resume_test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::hasDoneFrames;
using test::readText;
using test::RunningProgram;
using test::runProgram;
using test::scratchFolder;

// A tuft on a ball that shakes in a wind that changes, as its material does: contacts, a body, air, the
// numbers of all of them; a field that comes up, and some strands that are held and let go.
constexpr const char* kScene = R"(
[groom]
file = "tuft.obj"
[motion]
kind = "shake"
pre_roll = 0.1
[simulation]
frames = 24
steps_per_frame = 4
[contacts]
method = "explicit"
on = true
radius = 0.006
[air]
on = true
wind = [1, 0, 2]
[[body]]
name = "ball"
shape = "sphere"
radius = 0.03
position = [0, -0.05, 0]
[[key]]
time = 0.2
air.wind = [1, 0, 2]
material.dials.hold = 1
field.fan.strength = 0
[[key]]
time = 0.8
air.wind = [0, 0, 4]
material.dials.hold = 3
field.fan.strength = 8
[[field]]
name = "fan"
kind = "vortex"
drag = 3
bind = "head"
[[hold]]
strands = "0:9"
gather = 0.4
bind = "world"
start = 0.1
release = 0.7
ease = 0.3
)";

// 40 strands of 16 particles that wind through one another, in centimetres.
void writeTuft(const fs::path& path) {
  std::ofstream file(path);
  for (int s = 0; s < 40; ++s) {
    for (int i = 0; i < 16; ++i) {
      const double turn = 0.9 * i + s;
      file << "v " << 0.4 * (s % 8) + std::cos(turn) << ' ' << -0.6 * i << ' '
           << 0.4 * (s / 8) + std::sin(turn) << '\n';
    }
  }
  for (int s = 0; s < 40; ++s) {
    file << 'l';
    for (int i = 0; i < 16; ++i) file << ' ' << 16 * s + i + 1;
    file << '\n';
  }
}

class Resume : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    if (isGpu()) RINGLET_NEEDS_DEVICE(folder_);
    writeTuft(folder_ / "tuft.obj");
    std::ofstream(folder_ / "scene.toml") << kScene;
    static std::map<std::string, std::pair<fs::path, json>> wholeRuns;  // one a backend and process
    auto& [folder, report] = wholeRuns[GetParam()];
    if (folder.empty()) {
      folder = scratchFolder(std::string("resume_whole_") + GetParam());
      const auto whole = run(folder.string(), {"--json"});
      ASSERT_EQ(whole.exitCode, 0) << whole.err;
      report = json::parse(whole.out, nullptr, false);
      ASSERT_TRUE(report.is_object());
      ASSERT_GT(report["contacts"], 0) << "nothing touches, and nothing is tested";
    }
    whole_ = folder;
    report_ = report;
  }

  static bool isGpu() { return GetParam() == std::string("gpu"); }
  std::vector<std::string> argumentsOf(const std::string& out, const std::vector<std::string>& more) const {
    std::vector<std::string> all{"simulate", "scene.toml", "--backend", GetParam(),
                                 "--cache",  "float32",    "-o",        out};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  test::ProgramResult run(const std::string& out, const std::vector<std::string>& more) const {
    return runProgram(folder_, argumentsOf(out, more));
  }

  // Ends the run in "out", and holds all it wrote against the run without a break.
  void resumeToTheSameBits(const std::string& how) const {
    const bool isLeft = fs::exists(folder_ / "out/.ringlet.lock");
    const auto resumed = run("out", {"--resume", "--json"});
    ASSERT_EQ(resumed.exitCode, 0) << how << ": " << resumed.err;
    EXPECT_EQ(resumed.err.find("takes it over") != std::string::npos, isLeft) << how << ": " << resumed.err;
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_ / "out"))
      names.push_back(entry.path().filename());
    std::ranges::sort(names);
    EXPECT_EQ(names, (std::vector<std::string>{"hair.rgc", "hair.usda", "last.obj", "sheet.png"})) << how;
    for (const std::string& name : names)
      EXPECT_TRUE(readText(folder_ / "out" / name) == readText(whole_ / name)) << how << ": " << name;
    const json report = json::parse(resumed.out, nullptr, false);
    for (const auto& [key, value] : report_.items()) {
      const bool isOfTime =
          key.ends_with("ms") || key.ends_with("_s") || key == "ms_per_frame" || key == "compute_share";
      if (isOfTime || key == "outputs" || key == "warnings" || key == "resumed_from") continue;
      EXPECT_EQ(report[key], value) << how << ": " << key;
    }
  }

  fs::path folder_ = scratchFolder(std::string("resume_") + GetParam());
  fs::path whole_;  // a run without a break, and what it reported
  json report_;
};
INSTANTIATE_TEST_SUITE_P(Both, Resume, testing::Values("reference", "gpu"),
                         [](const testing::TestParamInfo<const char*>& backend) { return backend.param; });

TEST_P(Resume, KilledRunsGoOn) {
  for (const int killedAt : isGpu() ? std::vector{6} : std::vector{1, 6, 15, 23}) {
    fs::remove_all(folder_ / "out");
    RunningProgram program(folder_, argumentsOf("out", {"--checkpoint", "5", "--json-progress", "--quiet"}));
    EXPECT_TRUE(program.waitUntil([&] {
      const std::string lines = readText(folder_ / "stdout.txt");
      return std::ranges::count(lines, '\n') >= killedAt;
    }));
    program.send(SIGKILL);
    (void)program.wait();
    EXPECT_TRUE(fs::exists(folder_ / "out/.ringlet.lock")) << "what it was killed in";
    resumeToTheSameBits("killed at frame " + std::to_string(killedAt));
  }
}

TEST_P(Resume, AKilledResumeGoesOn) {
  for (int k = 0; k < 2; ++k) {
    RunningProgram program(
        folder_, argumentsOf("out", {"--checkpoint", "2", "--resume", "--json-progress", "--quiet"}));
    EXPECT_TRUE(program.waitUntil([&] {
      const std::string lines = readText(folder_ / "stdout.txt");
      return std::ranges::count(lines, '\n') >= 4;
    }));
    program.send(SIGKILL);
    (void)program.wait();
  }
  resumeToTheSameBits("killed twice");
}

// --resume alone writes checkpoints as often as the run that it goes on with did.
TEST_P(Resume, AResumeWritesCheckpointsUnasked) {
  const auto frameOf = [&] {
    const auto checkpoint = readCheckpoint(folder_ / "out/checkpoint.rgk");
    return checkpoint ? checkpoint->frame : 0;
  };
  int first = 0;
  for (const bool resumes : {false, true}) {
    RunningProgram program(
        folder_, argumentsOf("out", resumes ? std::vector<std::string>{"--resume", "--quiet"}
                                            : std::vector<std::string>{"--checkpoint", "2", "--quiet"}));
    EXPECT_TRUE(program.waitUntil([&] { return frameOf() > first; })) << resumes;
    program.send(SIGKILL);
    EXPECT_EQ(program.wait().exitCode, -1) << "it ended before it was killed";
    EXPECT_GT(frameOf(), first) << resumes;
    first = frameOf();
  }
  resumeToTheSameBits("killed above its first checkpoint");
}

TEST_P(Resume, AnInterruptedRunGoesOn) {
  RunningProgram program(folder_, argumentsOf("out", {"--checkpoint", "100", "--json-progress", "--quiet"}));
  EXPECT_TRUE(program.waitUntil([&] { return !readText(folder_ / "stdout.txt").empty(); }));
  program.send(SIGTERM);
  const auto result = program.wait();
  EXPECT_EQ(result.exitCode, 130);
  EXPECT_NE(result.err.find("--resume goes on from there"), std::string::npos) << result.err;
  resumeToTheSameBits("interrupted");
}

// A checkpoint knows nothing of what keys did before it: a material that came back to what it was, hair that
// sleeps since nothing changes any more.
const struct {
  const char* what;
  const char* scene;
  int frames, killedAt;
} kKeyedScenes[] = {{"a material came back",
                     "[groom]\nfile = \"tuft.obj\"\n[motion]\nkind = \"shake\"\n"
                     "[[key]]\ntime = 0.1\nmaterial.dials.weight = 1\n"
                     "[[key]]\ntime = 0.2\nmaterial.dials.weight = 0.7\n"
                     "[[key]]\ntime = 0.3\nmaterial.dials.weight = 1\n",
                     24, 14},
                    {"hair sleeps",
                     "[groom]\nfile = \"tuft.obj\"\n[motion]\nkind = \"still\"\n"
                     "[simulation]\npreload = 1\nsleep_speed = 0.1\n[air]\nwind = [0.1, 0, 0]\n"
                     "[[key]]\ntime = 0.1\nair.wind = [0.1, 0, 0]\n"
                     "[[key]]\ntime = 0.2\nair.wind = [0, 0, 0]\n",
                     120, 90},
                    {"hair was cut",
                     "[groom]\nfile = \"tuft.obj\"\n[motion]\nkind = \"shake\"\npre_roll = 0.1\n"
                     "[[cut]]\ntime = -0.05\nat = 0.7\nstrands = \"0\"\n[[cut]]\ntime = 0.15\n"
                     "[[key]]\ntime = 0.1\nmaterial.dials.weight = 1\nmaterial.dials.hold = 1\n"
                     "[[key]]\ntime = 0.2\nmaterial.dials.weight = 0.7\nmaterial.dials.hold = 0.7\n"
                     "[[key]]\ntime = 0.3\nmaterial.dials.weight = 1\nmaterial.dials.hold = 1\n",
                     24, 14},
                    {"hair with contacts was cut",
                     "[groom]\nfile = \"tuft.obj\"\n[motion]\nkind = \"shake\"\n[contacts]\n"
                     "method = \"explicit\"\ntaper = \"time\"\n[[cut]]\ntime = 0.15\n",
                     24, 14}};

TEST_P(Resume, WhatKeysDidBeforeIsDoneAgain) {
  for (const auto& c : kKeyedScenes) {
    std::ofstream(folder_ / "keys.toml") << c.scene;
    const auto arguments = [&](const char* out) {
      return std::vector<std::string>{"simulate",
                                      "keys.toml",
                                      "--backend",
                                      GetParam(),
                                      "--frames",
                                      std::to_string((isGpu() ? 10 : 1) * c.frames),  // it is fast there
                                      "--cache",
                                      "float32",
                                      "--no-usd",
                                      "--no-sheet",
                                      "--checkpoint",
                                      "5",
                                      "--resume",
                                      "--json-progress",
                                      "--quiet",
                                      "-o",
                                      out};
    };
    for (const char* out : {"keys_whole", "keys_out"}) fs::remove_all(folder_ / out);
    ASSERT_EQ(runProgram(folder_, arguments("keys_whole")).exitCode, 0) << c.what;
    RunningProgram program(folder_, arguments("keys_out"));
    EXPECT_TRUE(program.waitUntil([&] {
      const std::string lines = readText(folder_ / "stdout.txt");
      return std::ranges::count(lines, '\n') >= c.killedAt && hasDoneFrames(folder_ / "keys_out");
    }));
    program.send(SIGKILL);
    EXPECT_EQ(program.wait().exitCode, -1) << c.what << ": it ended before it was killed";
    const auto resumed = runProgram(folder_, arguments("keys_out"));
    ASSERT_EQ(resumed.exitCode, 0) << c.what << ": " << resumed.err;
    EXPECT_EQ(resumed.out.find("\"frame\": 1,"), std::string::npos) << c.what << ": it began anew";
    EXPECT_TRUE(readText(folder_ / "keys_out/hair.rgc") == readText(folder_ / "keys_whole/hair.rgc"))
        << c.what;
  }
}

TEST_P(Resume, AfterAFullDiskTheRunGoesOn) {
  const auto size = fs::file_size(whole_ / "hair.usda");
  for (const double share : isGpu() ? std::vector{0.6} : std::vector{0.3, 0.6, 0.95}) {
    fs::remove_all(folder_ / "out");
    struct rlimit before {};
    ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
    struct rlimit small = before;
    small.rlim_cur = static_cast<rlim_t>(share * static_cast<double>(size));
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
    const auto result = run("out", {"--checkpoint", "1", "--quiet"});
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
    EXPECT_EQ(result.exitCode, 6) << result.err;
    resumeToTheSameBits("a disk full at " + std::to_string(share));
  }
}

// A layer between the program and the driver lets calls fail (tests/fault_layer).
TEST_P(Resume, AfterALostDeviceTheRunGoesOn) {
  if (!isGpu()) return;
  setenv("VK_LAYER_PATH", RINGLET_LAYER_DIR, 1);
  setenv("VK_INSTANCE_LAYERS", "VK_LAYER_RINGLET_fault", 1);
  struct Case {
    const char* fault;
    int exitCode;
    const char* message;
  };
  for (const Case& c : {Case{"vkQueueSubmit:9:-4", 10, "VK_ERROR_DEVICE_LOST"},
                        Case{"vkWaitForFences:8:-4", 10, "VK_ERROR_DEVICE_LOST"},
                        Case{"vkQueueSubmit:4:-1", 8, "VK_ERROR_OUT_OF_HOST_MEMORY"},
                        Case{"vkAllocateMemory:7:-2", 9, "VK_ERROR_OUT_OF_DEVICE_MEMORY"},
                        Case{"vkCreateComputePipelines:3:-13", 11, "could not make the kernel"}}) {
    setenv("RINGLET_FAULT", c.fault, 1);
    const auto failed = run("out", {"--checkpoint", "3", "--resume", "--quiet"});
    unsetenv("RINGLET_FAULT");
    EXPECT_EQ(failed.exitCode, c.exitCode) << c.fault << failed.err;
    EXPECT_NE(failed.err.find(c.message), std::string::npos) << failed.err;
    EXPECT_FALSE(fs::exists(folder_ / "out/hair.usda")) << c.fault;
  }
  resumeToTheSameBits("lost devices");
  unsetenv("VK_INSTANCE_LAYERS");
}

TEST_P(Resume, WhatDiffersIsSaid) {
  setenv("VK_LAYER_PATH", "", 1);
  RunningProgram program(folder_, argumentsOf("out", {"--checkpoint", "3", "--json-progress", "--quiet"}));
  EXPECT_TRUE(program.waitUntil([&] { return !readText(folder_ / "stdout.txt").empty(); }));
  program.send(SIGKILL);
  (void)program.wait();
  const auto refused = [&](const std::vector<std::string>& more, const std::string& what) {
    std::vector<std::string> arguments{"--resume"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const auto result = run("out", arguments);
    EXPECT_EQ(result.exitCode, 4) << what;
    EXPECT_NE(result.err.find("is of another run"), std::string::npos) << result.err;
    EXPECT_NE(result.err.find(what), std::string::npos) << result.err;
  };
  refused({"--frames", "25"}, "frames is 25 and was 24");
  refused({"--gravity", "9"}, "gravity");
  refused({"--bounce", "1.2"},
          "of another run: [material.dials] bounce is 1.2 and was not given; material inertia_factor is 1.2 "
          "and was "
          "1.0. Ask");
  refused({"--no-usd"}, "hair.usda is false and was true");
  if (isGpu()) refused({"--kernel", "serial"}, "kernel is serial");
  const std::string groom = readText(folder_ / "tuft.obj");
  std::ofstream(folder_ / "tuft.obj", std::ios::app) << "# more\n";
  refused({}, "the content of tuft.obj");
  std::ofstream(folder_ / "tuft.obj") << groom;
  std::string damaged = readText(folder_ / "out/checkpoint.rgk");
  const std::string whole = damaged;
  damaged[damaged.size() / 2] ^= 1;
  std::ofstream(folder_ / "out/checkpoint.rgk") << damaged;
  const auto result = run("out", {"--resume"});
  EXPECT_EQ(result.exitCode, 4);
  EXPECT_NE(result.err.find("is damaged"), std::string::npos) << result.err;
  std::ofstream(folder_ / "out/checkpoint.rgk") << whole;
  resumeToTheSameBits("after refusals");
}

TEST_P(Resume, AFolderBelongsToOneRun) {
  RunningProgram first(folder_, argumentsOf("out", {"--frames", "100000", "--json-progress", "--quiet"}));
  EXPECT_TRUE(first.waitUntil([&] { return !readText(folder_ / "stdout.txt").empty(); }));
  const fs::path elsewhere = scratchFolder(std::string("resume_second_") + GetParam());
  fs::copy(folder_ / "tuft.obj", elsewhere / "tuft.obj");
  const auto second = [&](const std::vector<std::string>& more) {
    std::vector<std::string> all{"simulate", "tuft.obj", "--frames", "2", "-o", (folder_ / "out").string()};
    all.insert(all.end(), more.begin(), more.end());
    return runProgram(elsewhere, all);
  };
  for (const char* how : {"--quiet", "--overwrite", "--resume"}) {
    const auto refused = second({how});
    EXPECT_EQ(refused.exitCode, 7) << how;
    EXPECT_NE(refused.err.find("is being written by process"), std::string::npos) << refused.err;
  }
  first.send(SIGKILL);
  (void)first.wait();

  // What it leaves is kept until somebody says otherwise.
  const std::string left = readText(folder_ / "out/hair.usda.partial");
  const auto refused = second({});
  EXPECT_EQ(refused.exitCode, 5);
  EXPECT_NE(refused.err.find("hair.usda.partial"), std::string::npos) << refused.err;
  const auto failed = second({"--overwrite", "--device", "nosuch"});
  EXPECT_NE(failed.exitCode, 0);
  EXPECT_TRUE(readText(folder_ / "out/hair.usda.partial") == left) << "a command that failed touched it";
  const auto anew = second({"--overwrite", "--backend", GetParam()});
  EXPECT_EQ(anew.exitCode, 0) << anew.err;
}

TEST_P(Resume, AnInputIsNotOverwritten) {
  fs::copy(whole_ / "last.obj", folder_ / "last.obj");
  const std::string before = readText(folder_ / "last.obj");
  const auto result =
      runProgram(folder_, {"simulate", "last.obj", "--frames", "1", "-o", ".", "--backend", GetParam()});
  EXPECT_EQ(result.exitCode, 5);
  EXPECT_NE(result.err.find("would be overwritten"), std::string::npos) << result.err;
  EXPECT_EQ(readText(folder_ / "last.obj"), before);
}

}  // namespace
}  // namespace ringlet::resume_test
