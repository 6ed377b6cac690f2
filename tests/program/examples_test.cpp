// examples/*.toml: each runs, for a few frames, and has nothing to warn of.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/program/run_program.h"
#include "tests/support/test_support.h"

namespace ringlet::examples_test {
namespace {

namespace fs = std::filesystem;

TEST(Examples, EachSceneRuns) {
  const auto folder = test::scratchFolder("examples");
  RINGLET_NEEDS_DEVICE(folder);
  fs::copy(RINGLET_SOURCE_DIR "/examples", folder / "examples");
  // As examples/README.md says.
  const auto made = test::runProgram(folder, {"make", "head", "--strands", "300", "--particles", "32",
                                              "--turns", "6", "--length", "0.2", "-o", "examples/groom.obj"});
  ASSERT_EQ(made.exitCode, 0) << made.err;
  int count = 0;
  for (const auto& entry : fs::directory_iterator(folder / "examples")) {
    if (entry.path().extension() != ".toml") continue;
    ++count;
    const auto result = test::runProgram(
        folder, {"simulate", entry.path().string(), "--frames", "3", "--json", "--overwrite", "-o", "out"});
    EXPECT_EQ(result.exitCode, 0) << entry.path() << result.err;
    const auto report = nlohmann::json::parse(result.out, nullptr, false);
    ASSERT_TRUE(report.is_object()) << entry.path();
    EXPECT_EQ(report["warnings"].size(), 0u) << entry.path() << report["warnings"];
    EXPECT_EQ(report["frames"], 3) << entry.path();
  }
  EXPECT_GE(count, 6);
}

}  // namespace
}  // namespace ringlet::examples_test
