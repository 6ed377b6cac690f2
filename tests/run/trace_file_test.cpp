// Mirrors ringlet/run/trace_file.h.
#include "ringlet/run/trace_file.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "ringlet/run/divided_hair.h"
#include "ringlet/run/run.h"
#include "ringlet/scenes/file/scene_file.h"
#include "tests/support/gpu_test.h"
#include "tests/support/test_support.h"

namespace ringlet::trace_file_test {
namespace {

namespace fs = std::filesystem;

class TraceFile : public test::GpuTest {
 protected:
  static LoadedScene sceneOf(const std::string& more) {
    return *loadScene(
        *parseScene("[groom]\ngenerate = \"swatch\"\ncolumns = 2\nrows = 1\nparticles = 16\nturns = 2\n"
                    "[motion]\nkind = \"shake\"\npre_roll = 0.1\n[simulation]\nframes = 4\n" +
                        more,
                    "the scene"));
  }
  const fs::path folder_ = test::scratchFolder("trace");
};

// The dispatches of each frame lie in it, one after another, and are together what the run says of its
// stages.
TEST_F(TraceFile, HasEveryDispatchOfEveryFrame) {
  for (const char* more : {"", "[contacts]\non = true\n", "[contacts]\nradius = 0.02\n"}) {
    SCOPED_TRACE(more);
    const fs::path path = folder_ / "trace.json";
    const auto outcome = runScene(sceneOf(more), {.trace = path}, hairOn({device()}));
    ASSERT_TRUE(outcome) << outcome.error().message;
    const auto events = nlohmann::json::parse(test::readText(path));
    std::map<std::string, double> milliseconds;
    int frames = 0;
    double begin = 0, end = 0, over = 0;
    for (const auto& event : events) {
      if (event["ph"] == "M") continue;
      const double at = event["ts"], duration = event["dur"];
      if (event["tid"] == 1) {
        EXPECT_EQ(event["name"], "frame " + std::to_string(++frames));
        EXPECT_GE(at, end - 0.002);
        begin = at, end = at + duration, over = at;
        continue;
      }
      EXPECT_GE(at, begin - 0.002);
      EXPECT_LE(at + duration, end + 0.002);
      begin = at;
      if (device().limits().isCpu) {
        EXPECT_GE(at, over - 0.002) << "a processor does one after another";
      }
      over = at + duration;
      milliseconds[event["name"]] += duration / 1000;
    }
    EXPECT_EQ(frames, 4);
    EXPECT_GT(milliseconds["strand_step"], 0);
    for (const auto& [stage, sum] : milliseconds) {
      SCOPED_TRACE(stage);
      ASSERT_TRUE(outcome->stages.contains(stage));
      EXPECT_NEAR(sum / frames, outcome->stages.at(stage), 1e-3 + 1e-3 * sum);
    }
    for (const auto& [stage, mean] : outcome->stages) {
      const bool isOfHost = stage == "readback" || stage == "write";
      EXPECT_EQ(milliseconds.contains(stage), !isOfHost) << stage;
    }
  }
}

TEST_F(TraceFile, ThatCannotBeWrittenEndsTheRunBeforeItsFrames) {
  const fs::path path = folder_ / "missing" / "trace.json";
  const auto outcome = runScene(sceneOf(""), {.folder = folder_ / "out", .trace = path}, hairOn({device()}));
  ASSERT_FALSE(outcome);
  EXPECT_NE(outcome.error().message.find(path.string()), std::string::npos) << outcome.error().message;
  EXPECT_FALSE(fs::exists(folder_ / "out" / "hair.usda"));
}

}  // namespace
}  // namespace ringlet::trace_file_test
