// Mirrors program/simulate/dump_run.h: `ringlet simulate --dump`.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "program/cli/exit_codes.h"
#include "tests/program/run_program.h"
#include "tests/support/gpu_test.h"
#include "tests/support/test_support.h"

namespace ringlet::dump_test {
namespace {

namespace fs = std::filesystem;
using test::runProgram;

class Dump : public test::GpuTest {
 protected:
  void SetUp() override {
    GpuTest::SetUp();
    if (IsSkipped() || HasFatalFailure()) return;
    ASSERT_EQ(runProgram(folder_, {"make", "swatch", "--columns", "2", "--rows", "2", "--particles", "8",
                                   "-o", "hair.obj"})
                  .exitCode,
              0);
  }
  test::ProgramResult dump(const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"simulate", "hair.obj", "--motion", "shake",
                                       "--frames", "2",        "-o",       "out"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return runProgram(folder_, arguments);
  }

  const fs::path folder_ = test::scratchFolder("dump");
};

TEST_F(Dump, WritesBuffersAndNoRun) {
  const auto dumped = dump({"--dump", "3"});
  ASSERT_EQ(dumped.exitCode, 0) << dumped.err;
  test::expectParts(dumped.out, {"out/step_3", "after step 3", "buffers.txt"});
  EXPECT_EQ(fs::file_size(folder_ / "out/step_3/positions.bin") % 16, 0u);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_ / "out"), fs::directory_iterator()), 1);

  const auto again = dump({"--dump", "3"});
  EXPECT_EQ(again.exitCode, program::kExitOutput);
  test::expectParts(again.err, {"ringlet simulate: ", "out/step_3", "it is there"});
}

TEST_F(Dump, WhatItCannotDoIsRefused) {
  const auto far = dump({"--dump", "5000"});
  EXPECT_EQ(far.exitCode, program::kExitInput);
  test::expectParts(far.err, {"after step 5000", "the scene has"});
  for (const std::vector<std::string>& other : {std::vector<std::string>{"--resume"},
                                                {"--overwrite"},
                                                {"--json"},
                                                {"--json-progress"},
                                                {"--checkpoint", "1"},
                                                {"--measure-contacts"},
                                                {"--devices", "0,0"},
                                                {"--backend", "reference"}}) {
    std::vector<std::string> arguments{"--dump", "1"};
    arguments.insert(arguments.end(), other.begin(), other.end());
    const auto refused = dump(arguments);
    EXPECT_EQ(refused.exitCode, program::kExitUsage) << other[0];
    test::expectParts(refused.err, {"--dump"});
  }
  EXPECT_FALSE(fs::exists(folder_ / "out"));
}

}  // namespace
}  // namespace ringlet::dump_test
