// `--devices`: strands divided among devices have the bits that they have on one.
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/program/run_program.h"
#include "tests/support/test_support.h"

namespace ringlet::split_test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::hasDoneFrames;
using test::readText;
using test::RunningProgram;
using test::runProgram;

class Split : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = test::scratchFolder("split");
    RINGLET_NEEDS_DEVICE(folder_);
    fs::copy(RINGLET_SOURCE_DIR "/examples", folder_ / "examples");
    ASSERT_EQ(runProgram(folder_, {"make", "head", "--strands", "41", "--particles", "20", "--turns", "4",
                                   "--vary-length", "0.5", "-o", "head.obj"})
                  .exitCode,
              0);
    const json plain = simulate("head.obj", 1, {"--frames", "1"}, "one");
    const std::string device = plain["device"];
    device_ = device.substr(0, device.find(' '));
  }

  std::vector<std::string> argumentsOf(const std::string& what, int devices,
                                       const std::vector<std::string>& more, const std::string& out) {
    std::vector<std::string> arguments = {"simulate", what,         "--cache",     "float32", "--no-usd",
                                          "--json",   "--no-sheet", "--overwrite", "-o",      out};
    if (devices > 1) {
      std::string list = device_;
      for (int k = 1; k < devices; ++k) list += "," + device_;
      arguments.insert(arguments.end(), {"--devices", list});
    }
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }
  json simulate(const std::string& what, int devices, const std::vector<std::string>& more,
                const std::string& out) {
    const auto result = runProgram(folder_, argumentsOf(what, devices, more, out));
    EXPECT_EQ(result.exitCode, 0) << result.err;
    return json::parse(result.out, nullptr, false);
  }

  // Checkpoints are there; it ends in the middle.
  void killAndGoOn(const std::string& contacts);

  fs::path folder_;
  std::string device_;
};

// A plain run, one whose contacts are looked at step by step, and a whole shot with a body, wind, a hold,
// maps and keys.
TEST_F(Split, OnTwoAndFourDevicesHairHasTheBitsOfOne) {
  const struct {
    std::string what;
    std::vector<std::string> options;
  } kRuns[] = {
      {"head.obj", {"--motion", "shake", "--frames", "4", "--contacts", "explicit"}},
      {"head.obj", {"--motion", "shake", "--frames", "4", "--contacts", "volume"}},
      {"head.obj", {"--motion", "shake", "--frames", "2", "--contacts", "auto", "--measure-contacts"}},
      {"examples/directed.toml", {"--frames", "2", "--contacts", "explicit"}},
      {"head.obj", {"--motion", "shake", "--frames", "6"}},
      {"head.obj", {"--motion", "shake", "--frames", "2", "--measure-contacts"}},
      {"head.obj", {"--motion", "shake", "--frames", "3", "--integrator", "point_jacobi"}},
      {"examples/directed.toml", {"--frames", "6"}}};
  for (const auto& run : kRuns) {
    const json one = simulate(run.what, 1, run.options, "one");
    for (const int devices : {2, 4}) {
      SCOPED_TRACE(run.what + " " + std::to_string(devices));
      const json split = simulate(run.what, devices, run.options, "split");
      EXPECT_TRUE(readText(folder_ / "one/hair.rgc") == readText(folder_ / "split/hair.rgc"));
      for (const char* name :
           {"positions_hash", "max_edge_stretch", "nonfinite", "warnings", "kernel", "rigid_strands"})
        EXPECT_EQ(one[name], split[name]) << name;
      const bool meets = std::ranges::find(run.options, "--contacts") != run.options.end();
      EXPECT_NE(one["contacts"].is_null(), meets);
      for (const char* name : {"contacts", "pair_tests", "rebuilds", "pairs", "volume_strands", "crossings",
                               "overlap_beyond_rest_sum"})
        EXPECT_EQ(one[name], split[name]) << name;
      if (meets) {  // a sum in another order
        EXPECT_NEAR(one["momentum_error"].get<double>(), split["momentum_error"].get<double>(), 1e-9);
      }
      EXPECT_NEAR(one["limited_share"].get<double>(), split["limited_share"].get<double>(), 1e-9);
      EXPECT_EQ(split["device"].get<std::string>().find(one["device"].get<std::string>() + " + "), 0u);
    }
  }
}

TEST_F(Split, ARunThatWasKilledGoesOn) {
  for (const char* contacts : {"off", "auto"}) killAndGoOn(contacts);
}

void Split::killAndGoOn(const std::string& contacts) {
  SCOPED_TRACE("contacts " + contacts);
  const std::string frames = contacts == "off" ? "600" : "150";
  const std::vector<std::string> options = {"--motion",     "shake", "--frames",   frames,
                                            "--checkpoint", "5",     "--contacts", contacts};
  fs::remove_all(folder_ / "killed");
  simulate("head.obj", 2, options, "whole");
  auto arguments = argumentsOf("head.obj", 2, options, "killed");
  std::ranges::replace(arguments, "--json", "--json-progress");
  std::ranges::replace(arguments, "--overwrite", "--quiet");
  RunningProgram program(folder_, arguments);
  EXPECT_TRUE(program.waitUntil([&] {
    const std::string lines = readText(folder_ / "stdout.txt");
    return std::ranges::count(lines, '\n') >= 30 && hasDoneFrames(folder_ / "killed");
  }));
  program.send(SIGKILL);
  EXPECT_EQ(program.wait().exitCode, -1) << "it ended before it was killed";
  arguments.push_back("--resume");
  const auto resumed = runProgram(folder_, arguments);
  ASSERT_EQ(resumed.exitCode, 0) << resumed.err;
  EXPECT_EQ(resumed.out.find("\"frame\": 1,"), std::string::npos) << "it began anew";
  EXPECT_TRUE(readText(folder_ / "whole/hair.rgc") == readText(folder_ / "killed/hair.rgc"));
}

TEST_F(Split, WhatCannotBeDividedIsRefused) {
  const auto refused = [&](const std::string& what, const std::vector<std::string>& more,
                           const char* message) {
    const auto result = runProgram(folder_, argumentsOf(what, 2, more, "refused"));
    EXPECT_NE(result.exitCode, 0) << message;
    EXPECT_NE(result.err.find(message), std::string::npos) << result.err;
  };
  refused("head.obj", {"--backend", "reference"}, "only --backend gpu has a device");
  refused("head.obj", {"--device", device_}, "--device");
  ASSERT_EQ(runProgram(folder_, {"make", "curl", "-o", "curl.obj"}).exitCode, 0);
  refused("curl.obj", {}, "2 devices are more than the groom's 1 strands");
}

}  // namespace
}  // namespace ringlet::split_test
