// A run to be rendered, made once for all tests of a suite, and small pictures of it.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/program/picture_file.h"
#include "tests/program/run_program.h"
#include "tests/support/test_support.h"

namespace ringlet::test {

inline constexpr int kRenderedFrames = 4;

// A folder with head.obj, a head of 120 strands, and out/, a run of it in every format; made once a suite.
class RenderedRun : public testing::Test {
 protected:
  void SetUp() override {
    const std::string suite = testing::UnitTest::GetInstance()->current_test_suite()->name();
    if (folder_.filename() == suite) return;
    const std::filesystem::path folder = scratchFolder(suite);
    RINGLET_NEEDS_DEVICE(folder);
    ASSERT_EQ(runProgram(folder, {"make", "head", "--strands", "120", "--particles", "24", "-o", "head.obj"})
                  .exitCode,
              0);
    const auto result = runProgram(
        folder, {"simulate", "head.obj", "--motion", "shake", "--frames", std::to_string(kRenderedFrames),
                 "--cache", "float32", "--usdc", "--no-sheet", "-o", "out"});
    ASSERT_EQ(result.exitCode, 0) << result.err;
    folder_ = folder;
  }

  ProgramResult run(const std::vector<std::string>& arguments) { return runProgram(folder_, arguments); }

  // Small pictures, and what is printed of them.
  nlohmann::json render(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "render");
    for (const char* each : {"--size", "96x54", "--samples", "1", "--json"}) arguments.push_back(each);
    const auto result = run(arguments);
    EXPECT_EQ(result.exitCode, 0) << result.err;
    return nlohmann::json::parse(result.out, nullptr, false);
  }

  void expectRefused(std::vector<std::string> arguments, int exitCode,
                     const std::vector<std::string>& parts) {
    arguments.insert(arguments.begin(), "render");
    const auto result = run(arguments);
    EXPECT_EQ(result.exitCode, exitCode) << result.err;
    for (const std::string& part : parts)
      EXPECT_NE(result.err.find(part), std::string::npos) << "'" << part << "' is not in: " << result.err;
  }

  Image picture(const std::filesystem::path& path) { return readPng(folder_ / path); }

  static inline std::filesystem::path folder_;
};

}  // namespace ringlet::test
