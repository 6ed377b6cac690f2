// What `ringlet` says: help, versions, and a sentence for every kind of wrong command line.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <regex>

#include "tests/program/run_program.h"
#include "tests/support/test_support.h"

namespace ringlet::command_line_test {
namespace {

using test::runProgram;
using test::scratchFolder;

void expectContains(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << "'" << part << "' is missing in:\n" << text;
}

TEST(Help, EveryCommandHasOptionsWithDefaultsAndAnExample) {
  const auto folder = scratchFolder("help");
  const std::vector<std::vector<std::string>> commands{
      {},          {"make"}, {"make", "curl"}, {"make", "swatch"}, {"make", "head"}, {"simulate"}, {"scene"},
      {"measure"}, {"info"}, {"devices"},      {"material"},       {"convert"},      {"tune"}};
  for (std::vector<std::string> command : commands) {
    command.push_back("--help");
    const auto result = runProgram(folder, command);
    EXPECT_EQ(result.exitCode, 0);
    EXPECT_EQ(result.err, "");
    expectContains(result.out, "\nExample");
  }
  const std::string help = runProgram(folder, {"simulate", "--help"}).out;
  for (const char* part : {"--frames",     "--fps",          "--steps-per-frame",
                           "--integrator", "--preload",      "--motion",
                           "--unit",       "--up",           "--device",
                           "--backend",    "--max-stretch",  "--roots",
                           "--iterations", "--no-chebyshev", "--kernel",
                           "--lanes",      "--run",          "compile_ms",
                           "--json",       "--quiet",        "else 0.01: centimetres)",
                           "m/s^2",        "ms_per_frame",   "velocity_residual",
                           "--cache",      "--no-usd",       "--untuned"}) {
    expectContains(help, part);
  }
}

TEST(Help, VersionIsNamed) {
  const auto result = runProgram(scratchFolder("version"), {"--version"});
  EXPECT_EQ(result.exitCode, 0);
  EXPECT_EQ(result.out.substr(0, 8), "ringlet ");
}

TEST(Usage, WrongCommandLinesExitWith2AndSayWhatWouldBeRight) {
  const auto folder = scratchFolder("usage");
  struct Case {
    std::vector<std::string> arguments;
    std::string message;
  };
  const std::vector<Case> cases{
      {{},
       "say what to do: make, simulate, sweep, info, measure, render, view, convert, scene, devices, tune, "
       "conform, "
       "kernels, "
       "material"},
      {{"simulat"}, "did you mean simulate?"},
      {{"make", "crul", "-o", "a.obj"}, "did you mean curl?"},
      {{"make", "curl"}, "--output is required"},
      {{"make", "curl", "-o", "a.xyz"}, "must end in .hair or .obj or .ply or .abc or .usda or .usdc"},
      {{"make", "curl", "--turns", "-3", "-o", "a.obj"}, "turns"},
      {{"make", "curl", "--length", "nan", "-o", "a.obj"}, "length"},
      {{"simulate"}, "GROOM is required"},
      {{"simulate", "a.obj"}, "--output is required"},
      {{"simulate", "a.obj", "-o", "o", "--frame", "3"}, "did you mean --frames?"},
      {{"simulate", "a.obj", "b.obj", "-o", "o"}, "one word too many: 'b.obj'"},
      {{"simulate", "a.obj", "-o", "o", "--frames", "0"}, "--frames: must be a whole number from 1"},
      {{"simulate", "a.obj", "-o", "o", "--frames", "-2"}, "--frames: must be a whole number from 1"},
      {{"simulate", "a.obj", "-o", "o", "--frames", "2.5"}, "--frames: must be a whole number from 1"},
      {{"simulate", "a.obj", "-o", "o", "--fps", "0"}, "--fps: must be a number from"},
      {{"simulate", "a.obj", "-o", "o", "--fps", "nan"}, "not 'nan'"},
      {{"simulate", "a.obj", "-o", "o", "--unit", "0"}, "--unit: must be a number from"},
      {{"simulate", "a.obj", "-o", "o", "--unit", "inf"}, "--unit: must be a number from"},
      {{"simulate", "a.obj", "-o", "o", "--preload", "1.5"}, "from 0 to 1"},
      {{"simulate", "a.obj", "-o", "o", "--max-stretch", "0.9"}, "from 1 to"},
      {{"simulate", "a.obj", "-o", "o", "--roots", "4"}, "from 1 to 3"},
      {{"simulate", "a.obj", "-o", "o", "--up", "X"}, "only Y, Z"},
      {{"simulate", "a.obj", "-o", "o", "--motion", "shak"}, "did you mean shake?"},
      {{"simulate", "a.obj", "-o", "o", "--motion", "dance"}, "only still, shake, nod, spin, glide"},
      {{"simulate", "a.obj", "-o", "o", "--integrator", "point-jacobi"}, "did you mean point_jacobi?"},
      {{"simulate", "a.obj", "-o", "o", "--backend", "cpu"}, "only gpu, reference"},
      {{"simulate", "a.obj", "-o", "o", "--iterations", "5"}, "only point_jacobi has it"},
      {{"simulate", "a.obj", "-o", "o", "--backend", "reference", "--device", "0"}, "only --backend gpu"},
  };
  for (const Case& c : cases) {
    const auto result = runProgram(folder, c.arguments);
    EXPECT_EQ(result.exitCode, 2) << c.message;
    EXPECT_EQ(result.out, "") << c.message;
    expectContains(result.err, c.message);
    EXPECT_EQ(result.err.substr(0, 7), "ringlet");
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "o"));
}

// Of every whole number that an option of the program takes.
TEST(Usage, NumbersThatAreTooLargeAreToldWithWhatIsAllowed) {
  const auto folder = scratchFolder("too_large");
  const std::vector<std::vector<std::string>> commands{
      {"make", "curl"}, {"make", "swatch"}, {"make", "head"}, {"simulate"}, {"sweep"},
      {"scene"},        {"measure"},        {"info"},         {"material"}, {"convert"},
      {"render"},       {"view"},           {"tune"},         {"conform"},  {"kernels"}};
  int tried = 0;
  for (const auto& command : commands) {
    const auto saidOf = [&](const std::vector<std::string>& more) {
      std::vector<std::string> all = command;
      all.insert(all.end(), more.begin(), more.end());
      const auto result = runProgram(folder, all);
      return result.exitCode == 2 ? result.err : "";
    };
    const std::string help = [&] {
      std::vector<std::string> all = command;
      all.push_back("--help");
      return runProgram(folder, all).out;
    }();
    const std::regex number("(--[a-z-]+) N[ \n]");
    for (auto at = std::sregex_iterator(help.begin(), help.end(), number); at != std::sregex_iterator();
         ++at) {
      const std::string option = (*at)[1];
      if (saidOf({option, "1.5"}).find("'1.5'") == std::string::npos) continue;  // it is a real one
      for (const char* large : {"100000000000", "99999999999999999999999"}) {
        const std::string said = saidOf({option, large});
        expectContains(said, command.back() + ": " + option + ": must be ");
        expectContains(said, "'" + std::string(large) + "'");
      }
      ++tried;
    }
  }
  EXPECT_GT(tried, 30);
}

TEST(Devices, ListsThemOrSaysThereAreNone) {
  const auto folder = scratchFolder("devices");
  const auto result = runProgram(folder, {"devices"});
  if (result.exitCode == 0) {
    expectContains(result.out, " GiB ");
    const auto json = nlohmann::json::parse(runProgram(folder, {"devices", "--json"}).out);
    ASSERT_FALSE(json["devices"].empty());
    for (const auto& device : json["devices"]) EXPECT_GT(device["memory_bytes"], 1 << 20) << device;
  } else {
    EXPECT_EQ(result.exitCode, 1);
    expectContains(result.err, "install a Vulkan driver");
  }
}

}  // namespace
}  // namespace ringlet::command_line_test
