// Mirrors program/cli/growing_report.h.
#include "program/cli/growing_report.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "tests/support/test_support.h"

namespace ringlet::program::growing_report_test {
namespace {

namespace fs = std::filesystem;

TEST(GrowingReport, AFileIsWholeAfterEveryGrowthWhetherItWasThereOrNot) {
  const fs::path path = test::scratchFolder("growing_report") / "report.json";
  for (const bool isThere : {false, true}) {
    ASSERT_EQ(fs::exists(path), isThere);
    const GrowingReport report(path);
    for (int k = 0; k < 3; ++k) {
      ASSERT_TRUE(report.grow({{"k", k}}));
      EXPECT_EQ(nlohmann::json::parse(test::readText(path))["k"], k);
    }
    ASSERT_TRUE(report.finish({{"k", "all"}}));
    EXPECT_EQ(nlohmann::json::parse(test::readText(path))["k"], "all");
  }
}

TEST(GrowingReport, WhatIsNoFileIsWrittenOnce) {
  const GrowingReport report("/dev/null");
  EXPECT_TRUE(report.grow({{"k", 1}}));
  EXPECT_TRUE(report.finish({{"k", 2}}));
  EXPECT_FALSE(fs::is_regular_file("/dev/null"));
  EXPECT_TRUE(GrowingReport("").finish({}));
  const fs::path missing = test::scratchFolder("growing_report") / "none/report.json";
  EXPECT_FALSE(GrowingReport(missing).grow({{"k", 1}}));
  EXPECT_FALSE(GrowingReport(missing).finish({{"k", 1}}));
}

}  // namespace
}  // namespace ringlet::program::growing_report_test
