// `ringlet kernels`: every kernel that could be planned, and what is said of one that fails.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/program/run_program.h"
#include "tests/support/test_support.h"

namespace ringlet {
namespace {

using nlohmann::json;
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

// On lavapipe without its optimiser, where a kernel takes a fifth of the time; others take no notice.
TEST_F(Kernels, AllOfThemCompile) {
  setenv("GALLIVM_DEBUG", "nopt", 1);
  const auto result = runProgram(folder_, {"kernels", "--statistics", "--json", "kernels.json"});
  unsetenv("GALLIVM_DEBUG");
  EXPECT_EQ(result.exitCode, 0) << result.out << result.err;
  const json report = json::parse(test::readText(folder_ / "kernels.json"), nullptr, false);
  ASSERT_TRUE(report.is_object());
  std::string names;
  for (const json& kernel : report["kernels"]) {
    names += kernel["name"].get<std::string>() + "\n";
    EXPECT_EQ(kernel["compiled"], true) << kernel;
    EXPECT_GT(kernel["seconds"].get<double>(), 0) << kernel;
  }
  for (const char* part : {"strand_step, hair alone, lanes", "strand_step, hair alone, serial",
                           "contacts, lanes", "bodies in air, lanes", "bodies, serial", "point_jacobi, lanes",
                           "paper, serial", "contact_motion", "contact_query", "contact_gather"})
    EXPECT_NE(names.find(part), std::string::npos) << part << " is not there:\n" << names;
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
}  // namespace ringlet
