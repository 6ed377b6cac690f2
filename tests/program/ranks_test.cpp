// `mpirun ringlet`: a run of hair on several ranks has the bits of one, and ends when one of them does.
#include <gtest/gtest.h>

#include <fmt/format.h>
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/program/run_program.h"
#include "tests/support/test_support.h"

namespace ringlet::ranks_test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::ProgramResult;
using test::readText;
using test::runProgram;

class Ranks : public testing::Test {
 protected:
  void SetUp() override {
#ifndef RINGLET_DELAYS
    GTEST_SKIP() << "SKIPPED: built without MPI (Debian: libopenmpi-dev openmpi-bin)";
#endif
    folder_ = test::scratchFolder("ranks");
    RINGLET_NEEDS_DEVICE(folder_);
    fs::copy(RINGLET_SOURCE_DIR "/examples", folder_ / "examples");
    ASSERT_EQ(runProgram(folder_, {"make", "head", "--strands", "41", "--particles", "20", "--turns", "4",
                                   "--vary-length", "0.5", "-o", "head.obj"})
                  .exitCode,
              0);
  }

  // A shell's command line of so many ranks; `environment` is theirs.
  std::string commandOf(int ranks, const std::string& arguments, const std::string& environment = "") const {
    return fmt::format(
        "export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 RINGLET_CACHE_DIR={0}/tests/cache "
        "{1}\n"
        "mpirun --oversubscribe -n {2} {0}/ringlet {3}",
        RINGLET_BUILD_DIR, environment, ranks, arguments);
  }
  ProgramResult shell(const std::string& script) const {
    const std::string all =
        fmt::format("cd '{}' && ( {} ) > stdout.txt 2> stderr.txt", folder_.string(), script);
    const int status = std::system(all.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, readText(folder_ / "stdout.txt"),
            readText(folder_ / "stderr.txt")};
  }
  ProgramResult launch(int ranks, const std::string& arguments, const std::string& environment = "") const {
    return shell(commandOf(ranks, arguments, environment));
  }

  static std::string simulate(const std::string& what, const std::string& out) {
    return fmt::format("simulate {} --cache float32 --no-usd --no-sheet --json --overwrite -o {}", what, out);
  }
  static std::vector<std::string> words(const std::string& text) {
    std::vector<std::string> all;
    for (std::size_t begin = 0; begin < text.size();) {
      const std::size_t end = std::min(text.find(' ', begin), text.size());
      all.push_back(text.substr(begin, end - begin));
      begin = end + 1;
    }
    return all;
  }

  fs::path folder_;
};

TEST_F(Ranks, HaveTheBitsOfOne) {
  const struct {
    std::string what;
    std::vector<int> ranks;
  } kRuns[] = {{"head.obj --motion shake --frames 3 --contacts explicit", {2, 4}},
               {"head.obj --motion shake --frames 2 --contacts volume", {3}},
               {"head.obj --motion shake --frames 1 --contacts auto --measure-contacts", {2}},
               {"examples/directed.toml --frames 2 --contacts explicit", {2}},
               {"examples/directed.toml --frames 3", {3}}};
  for (const auto& [what, rankCounts] : kRuns) {
    const auto one = runProgram(folder_, words(simulate(what, "one")));
    ASSERT_EQ(one.exitCode, 0) << one.err;
    const json alone = json::parse(one.out);
    for (const int ranks : rankCounts) {
      SCOPED_TRACE(fmt::format("{} on {} ranks", what, ranks));
      const auto divided = launch(ranks, simulate(what, "divided"));
      ASSERT_EQ(divided.exitCode, 0) << divided.err;
      const json together = json::parse(divided.out);
      EXPECT_TRUE(readText(folder_ / "one/hair.rgc") == readText(folder_ / "divided/hair.rgc"));
      for (const char* name : {"positions_hash", "max_edge_stretch", "nonfinite", "warnings", "rigid_strands",
                               "contacts", "pair_tests", "rebuilds", "crossings"})
        EXPECT_EQ(alone[name], together[name]) << name;
      EXPECT_FALSE(alone["frame_ms"].is_null());
      EXPECT_TRUE(together["frame_ms"].is_null()) << "what would be a message a frame";
      EXPECT_EQ(std::ranges::count(together["device"].get<std::string>(), '+'), ranks - 1);
    }
  }
}

// Keys, fields and goals change between frames.
TEST_F(Ranks, WhatChangesWhileItRunsToo) {
  std::ofstream(folder_ / "keyed.toml") << R"([groom]
file = "head.obj"
[[field]]
name = "blow"
kind = "uniform"
[goal]
strength = 5
[[key]]
time = 0
simulation.gravity = -9.81
material.dials.weight = 1
field.blow.strength = 0
goal.strength = 0
[[key]]
time = 0.1
simulation.gravity = -3
material.dials.weight = 0.7
field.blow.strength = 8
goal.strength = 5
)";
  const std::string what = "keyed.toml --frames 4";
  const auto one = runProgram(folder_, words(simulate(what, "one")));
  ASSERT_EQ(one.exitCode, 0) << one.err;
  const auto divided = launch(2, simulate(what, "divided"));
  ASSERT_EQ(divided.exitCode, 0) << divided.err;
  EXPECT_TRUE(readText(folder_ / "one/hair.rgc") == readText(folder_ / "divided/hair.rgc"));
}

TEST_F(Ranks, ABuiltInSceneToo) {
  const std::string scene = "scene curtain --strands 12 --seconds 0.1 --json";
  const auto one = runProgram(folder_, words(scene));
  ASSERT_EQ(one.exitCode, 0) << one.err;
  for (const int ranks : {2, 3}) {
    const auto divided = launch(ranks, scene);
    ASSERT_EQ(divided.exitCode, 0) << divided.err;
    EXPECT_EQ(json::parse(divided.out)["positions_hash"], json::parse(one.out)["positions_hash"]);
  }
  // What it measures in a second run of the hair.
  const auto turning = launch(2, "scene twist_jump --strands 4 --seconds 0.1 --json");
  EXPECT_EQ(turning.exitCode, 0) << turning.err;
}

// Messages are late, now here, now there.
TEST_F(Ranks, WhoeverIsLate) {
#ifdef RINGLET_DELAYS
  const std::string what = "head.obj --motion shake --frames 2 --contacts auto";
  const auto one = runProgram(folder_, words(simulate(what, "one")));
  ASSERT_EQ(one.exitCode, 0) << one.err;
  for (int seed = 1; seed <= 3; ++seed) {
    const auto divided = launch(3, simulate(what, "late"),
                                fmt::format("LD_PRELOAD={} RINGLET_DELAY_SEED={}", RINGLET_DELAYS, seed));
    ASSERT_EQ(divided.exitCode, 0) << divided.err;
    EXPECT_EQ(json::parse(divided.out)["positions_hash"], json::parse(one.out)["positions_hash"]) << seed;
  }
#endif
}

// The others end with it, and the run goes on from its checkpoint.
TEST_F(Ranks, ARankThatDiesEndsTheRun) {
  const std::string run =
      "simulate head.obj --motion shake --frames 200 --contacts auto --checkpoint 5 --cache float32 --no-usd "
      "--no-sheet --quiet";
  ASSERT_EQ(runProgram(folder_, words(run + " -o whole")).exitCode, 0);
  const auto died = shell(commandOf(3, run + " --json-progress -o died") + R"sh( &
    launcher=$!
    for _ in $(seq 3000); do
      # The checkpoint from before the first frame is small.
      [ -n "$(find died -name checkpoint.rgk -size +16k 2> /dev/null)" ] && [ "$(wc -l < stdout.txt)" -ge 20 ] && break
      sleep 0.01
    done
    pkill -KILL -n -P $launcher
    wait $launcher)sh");
  EXPECT_NE(died.exitCode, 0) << "it ended before it was killed";
  EXPECT_NE(died.err.find("signal 9"), std::string::npos) << died.err;
  const auto resumed = launch(3, run + " --json-progress -o died --resume");
  ASSERT_EQ(resumed.exitCode, 0) << resumed.err;
  EXPECT_EQ(resumed.out.find("\"frame\": 1,"), std::string::npos) << "it began anew";
  EXPECT_TRUE(readText(folder_ / "whole/hair.rgc") == readText(folder_ / "died/hair.rgc"));
}

TEST_F(Ranks, WhatIsWrongIsSaidOnce) {
  const auto refused = [&](int ranks, const std::string& arguments, const std::string& message) {
    const auto result = launch(ranks, arguments);
    EXPECT_NE(result.exitCode, 0) << message;
    const std::size_t at = result.err.find(message);
    EXPECT_NE(at, std::string::npos) << result.err;
    EXPECT_EQ(result.err.find(message, at + 1), std::string::npos) << result.err;
  };
  refused(2, "make head -o other.obj", "only simulate and scene run on several ranks");
  refused(2, "simulate absent.obj -o out", "absent.obj");
  refused(2, "simulate head.obj --device nosuch -o out", "nosuch");
  refused(2, "simulate head.obj --frames none -o out", "--frames");
  refused(2, "simulate head.obj --frames 1 --dump 1 -o out", "start it without mpirun");
  ASSERT_EQ(runProgram(folder_, {"make", "curl", "-o", "curl.obj"}).exitCode, 0);
  refused(2, "simulate curl.obj -o out", "2 ranks are more than the groom's 1 strands");
  // Rank 0 alone has a folder.
  refused(2, "simulate head.obj --frames 2 -o head.obj/out", "head.obj/out");
}

}  // namespace
}  // namespace ringlet::ranks_test
