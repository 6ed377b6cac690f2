// run/run.h: what a run asks and tells, in which order, and how it ends.
#include "ringlet/run/run.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "ringlet/output/positions_hash.h"
#include "ringlet/run/divided_hair.h"
#include "ringlet/scenes/file/scene_file.h"
#include "tests/support/gpu_test.h"
#include "tests/support/test_support.h"

namespace ringlet::run_test {
namespace {

namespace fs = std::filesystem;

class RunTest : public test::GpuTest {
 protected:
  const LoadedScene scene_ = *loadScene(
      *parseScene("[groom]\ngenerate = \"swatch\"\ncolumns = 2\nrows = 1\nparticles = 16\nturns = 2\n"
                  "[motion]\nkind = \"shake\"\npre_roll = 0.1\n[simulation]\nframes = 6\n",
                  "the scene"));
  const fs::path folder_ = test::scratchFolder("run");
};

TEST_F(RunTest, TellsEveryFrameInOrderAndTheFirstOnce) {
  std::vector<int> computed, written, progress;
  std::vector<std::vector<Vec3f>> positions;
  int first = 0, observed = 0;
  RunEvents events{.isStopped = [] { return false; },
                   .progress = [&](int frames) { progress.push_back(frames); },
                   .firstFrame =
                       [&] {
                         ++first;
                         EXPECT_TRUE(computed.empty());
                       },
                   .computed =
                       [&](const ComputedFrame& frame) {
                         computed.push_back(frame.number);
                         positions.push_back(frame.positions);
                       },
                   .written = [&](int frame) { written.push_back(frame); },
                   .observe = [&](std::span<const Vec3f> points, const HeadPose&) -> Status {
                     ++observed;
                     EXPECT_EQ(points.size(), 32u);
                     return {};
                   }};
  const auto outcome = runScene(scene_, {.folder = folder_}, hairOn({device()}), events);
  ASSERT_TRUE(outcome) << outcome.error().message;
  const std::vector<int> all{1, 2, 3, 4, 5, 6};
  EXPECT_EQ(computed, all);
  EXPECT_EQ(written, all);
  EXPECT_EQ(observed, 6);
  EXPECT_EQ(first, 1);
  ASSERT_EQ(progress.size(), 7u);  // before each frame, and after the last
  EXPECT_TRUE(std::ranges::is_sorted(progress));
  EXPECT_EQ(progress.back(), 6);
  EXPECT_EQ(outcome->positions, positions.back());
  EXPECT_EQ(outcome->positionsHash, positionsHash(positions.back()));
  EXPECT_FALSE(outcome->interrupted);
}

TEST_F(RunTest, EndsEarlyWithWhatIsFinished) {
  auto run = Run::open(scene_, {.folder = folder_}, hairOn({device()}));
  ASSERT_TRUE(run) << run.error().message;
  for (int frame = 0; frame < 3; ++frame) EXPECT_TRUE(*run->next());
  const auto outcome = run->finish();
  ASSERT_TRUE(outcome) << outcome.error().message;
  EXPECT_EQ(outcome->frameCount, 3);
  EXPECT_TRUE(outcome->interrupted);
  EXPECT_FALSE(outcome->canResume);
  EXPECT_EQ(outcome->outputs.size(), 3u);
  for (const fs::path& file : outcome->outputs) EXPECT_TRUE(fs::exists(file)) << file;
}

TEST_F(RunTest, StoppedInThePreRollHasTheStart) {
  int asked = 0;
  const auto outcome = runScene(scene_, {}, hairOn({device()}), {.isStopped = [&] { return ++asked > 1; }});
  ASSERT_TRUE(outcome) << outcome.error().message;
  EXPECT_EQ(outcome->frameCount, 0);
  EXPECT_TRUE(outcome->interrupted);
  EXPECT_EQ(outcome->positions.size(), 32u);
}

TEST_F(RunTest, WhatAnObserverRefusesEndsIt) {
  RunEvents events{.observe = [](std::span<const Vec3f>, const HeadPose&) -> Status { return Error{"no"}; }};
  const auto outcome = runScene(scene_, {.folder = folder_}, hairOn({device()}), events);
  ASSERT_FALSE(outcome);
  EXPECT_EQ(outcome.error().message, "no");
}

// A groom's own hairs, by the device.
TEST_F(RunTest, HairsOfTheGroomAreWrittenAndMeasured) {
  const std::string groom =
      "[groom]\ngenerate = \"swatch\"\ncolumns = 6\nrows = 5\nparticles = 16\nturns = 2\nguides = 8\n";
  const std::string frames = "[simulation]\nframes = 6\n";
  for (const int sample : {0, 6}) {
    for (const char* motion : {"still", "shake"}) {
      SCOPED_TRACE(fmt::format("{}, {} measured", motion, sample));
      const auto scene = loadScene(*parseScene(
          fmt::format("{}guides_sample = {}\n{}[motion]\nkind = \"{}\"\n", groom, sample, frames, motion),
          "the scene"));
      ASSERT_TRUE(scene) << scene.error().message;
      const auto outcome = runScene(
          *scene, {.folder = folder_, .mover = followOn(device()), .leftovers = Leftovers::overwrite},
          hairOn({device()}));
      ASSERT_TRUE(outcome) << outcome.error().message;
      EXPECT_EQ(outcome->strandCount, 8u + std::size_t(sample));
      EXPECT_EQ(outcome->hairCount, 30u);
      ASSERT_EQ(outcome->follow.has_value(), sample > 0);
      if (sample == 0) continue;
      EXPECT_EQ(outcome->follow->hairs, 6u);
      EXPECT_GE(outcome->follow->worst, outcome->follow->rms);
      if (std::string(motion) == "still") {
        EXPECT_LT(outcome->follow->worst, 1e-4);
      } else {
        EXPECT_GT(outcome->follow->rms, 1e-4);
        EXPECT_LT(outcome->follow->rms, 0.1);
      }
    }
  }
}

TEST_F(RunTest, HairsThatFollowNeedAMover) {
  const auto still = runScene(scene_, {.folder = folder_, .hairs = 50}, hairOn({device()}));
  ASSERT_FALSE(still);
  EXPECT_NE(still.error().message.find("nothing that moves"), std::string::npos) << still.error().message;
  const auto moved = runScene(
      scene_,
      {.folder = folder_, .hairs = 50, .mover = followOn(device()), .leftovers = Leftovers::overwrite},
      hairOn({device()}));
  EXPECT_TRUE(moved) << moved.error().message;
}

}  // namespace
}  // namespace ringlet::run_test
