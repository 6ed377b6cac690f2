// `ringlet kernels`: every kernel that could be planned, and what is said of one that fails.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/program/run_program.h"
#include "tests/support/test_support.h"

namespace ringlet::kernels_command_test {
namespace {

using nlohmann::json;
using test::RunningProgram;
using test::runProgram;
using test::scratchFolder;

class Kernels : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = scratchFolder("kernels");
    RINGLET_NEEDS_DEVICE(folder_);
  }
  std::filesystem::path folder_;
};

// Not all that is listed: strand kernels in lanes take a driver seconds each.
TEST_F(Kernels, CompileInEveryKindOfWork) {
  std::string names;
  for (const char* only : {"serial", "contact_", "hair alone, lanes"}) {
    const auto result =
        runProgram(folder_, {"kernels", "--statistics", "--only", only, "--json", "kernels.json"});
    EXPECT_EQ(result.exitCode, 0) << result.out << result.err;
    const json report = json::parse(test::readText(folder_ / "kernels.json"), nullptr, false);
    ASSERT_TRUE(report.is_object());
    for (const json& kernel : report["kernels"]) {
      const std::string name = kernel["name"];
      names += name + "\n";
      EXPECT_NE(name.find(only), std::string::npos) << name;
      EXPECT_EQ(kernel["compiled"], true) << kernel;
      EXPECT_GT(kernel["seconds"].get<double>(), 0) << kernel;
    }
  }
  for (const char* part :
       {"hair alone, lanes", "hair alone, serial", "contacts, serial", "bodies in air, serial",
        "point_jacobi, serial", "paper, serial", "contact_motion", "contact_query", "contact_gather"})
    EXPECT_NE(names.find(part), std::string::npos) << part << " is not there:\n" << names;
}

TEST_F(Kernels, WhatIsKnownIsThereWhenItIsKilled) {
  const auto file = folder_ / "kernels.json";
  RunningProgram program(folder_, {"kernels", "--only", "contact_", "--json", "kernels.json"});
  const auto known = [&] {
    const json report = json::parse(test::readText(file), nullptr, false);
    return report.is_object() ? report["kernels"].size() : 0;
  };
  EXPECT_TRUE(program.waitUntil([&] { return std::filesystem::exists(file) && known() >= 1; }));
  program.send(SIGKILL);
  EXPECT_EQ(program.wait().exitCode, -1) << "it was not done";
  const json report = json::parse(test::readText(file), nullptr, false);
  ASSERT_TRUE(report.is_object()) << "it is whole at every moment";
  EXPECT_EQ(report["kernels"][0]["compiled"], true);
  EXPECT_FALSE(report["driver"].get<std::string>().empty());
}

TEST_F(Kernels, StrandsAreInTheShapesThatAreAskedFor) {
  const auto result = runProgram(
      folder_, {"kernels", "--only", "hair alone", "--shapes", "2x5,1x7", "--json", "kernels.json"});
  EXPECT_EQ(result.exitCode, 0) << result.err;
  const json report = json::parse(test::readText(folder_ / "kernels.json"), nullptr, false);
  ASSERT_TRUE(report.is_object());
  ASSERT_EQ(report["kernels"].size(), 2u) << report;
  EXPECT_EQ(report["kernels"][0]["name"], "strand_step, hair alone, lanes 2 x 5");
  EXPECT_EQ(report["kernels"][1]["name"], "strand_step, hair alone, lanes 1 x 7");
  EXPECT_EQ(report["kernels"][0]["compiled"], true) << report;

  for (const char* none : {"3x4", "2x3", "2x9999", "2", "x", "two by four", "02x5"}) {
    const auto refused = runProgram(folder_, {"kernels", "--shapes", none});
    EXPECT_EQ(refused.exitCode, 1) << none;
    EXPECT_NE(refused.err.find("power of two"), std::string::npos) << refused.err;
  }
}

// The process that compiles the first kernel, by itself: one JSON line.
TEST_F(Kernels, AChildPrintsOneLine) {
  const auto result = runProgram(folder_, {"kernels", "--one", "0"});
  EXPECT_EQ(result.exitCode, 0) << result.err;
  EXPECT_EQ(std::count(result.out.begin(), result.out.end(), '\n'), 1) << result.out;
  const json line = json::parse(result.out, nullptr, false);
  ASSERT_TRUE(line.is_object()) << result.out;
  EXPECT_EQ(line["is_compiled"], true) << result.out;
}

TEST_F(Kernels, ThereAreNoMoreThanThereAre) {
  const auto result = runProgram(folder_, {"kernels", "--one", "9999"});
  EXPECT_EQ(result.exitCode, 1);
  EXPECT_NE(result.err.find("fewer kernels"), std::string::npos) << result.err;
}

}  // namespace
}  // namespace ringlet::kernels_command_test
