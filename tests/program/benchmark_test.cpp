// `ringlet measure --benchmark`: what it writes scores as it should, and what is wrong with a file shows.
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "program/measure/benchmark_cases.h"
#include "program/measure/benchmark_score.h"
#include "ringlet/output/animation_reader.h"
#include "ringlet/output/animation_writer.h"
#include "tests/program/run_program.h"
#include "tests/support/test_support.h"

namespace ringlet::program {
namespace {

namespace fs = std::filesystem;

class BenchmarkTest : public testing::Test {
 protected:
  void SetUp() override {
    const Status written = writeBenchmark(folder_);
    ASSERT_TRUE(written) << written.error().message;
  }

  using Change = std::function<void(int frame, const Groom&, std::vector<Vec3f>&)>;
  // What a simulator made of a case: the carried strands, changed. `first`: 0 for one with the rest in front.
  void simulate(const std::string& name, const Change& change, int first = 1, int left = 0) const {
    const fs::path of = folder_ / name;
    auto carried = AnimationReader::open(of / "carried.usdc");
    ASSERT_TRUE(carried) << carried.error().message;
    const CacheHeader& header = carried->header();
    const int last = carried->frameCount() - left;
    auto writer = createAnimation(of / "hair.abc", carried->groom(),
                                  {.framesPerSecond = header.framesPerSecond,
                                   .metresPerUnit = header.metresPerUnit,
                                   .diameter = header.diameter,
                                   .frameCount = last - first + 1});
    ASSERT_TRUE(writer) << writer.error().message;
    for (int frame = first; frame <= last; ++frame) {
      if (frame > 0) {
        ASSERT_TRUE(carried->readFrame(frame));
      }
      auto rest = AnimationReader::open(of / "carried.usdc");
      ASSERT_TRUE(rest->readFrame(1));
      std::vector<Vec3f> points = frame == 0 ? rest->groom().points : carried->groom().points;
      change(frame, carried->groom(), points);
      ASSERT_TRUE((*writer)->addFrame(points));
    }
    ASSERT_TRUE((*writer)->finish());
  }
  BenchmarkScore scoreOf(const std::string& name) const {
    const auto scores = scoreBenchmark(folder_);
    EXPECT_TRUE(scores) << scores.error().message;
    if (!scores) return {};
    for (const BenchmarkScore& score : scores->cases)
      if (score.name == name) return score;
    ADD_FAILURE() << "no case " << name;
    return {};
  }

  const fs::path folder_ = test::scratchFolder("benchmark");
};

// About each strand's root [unit].
void scaleStrands(const Groom& groom, float factor, std::vector<Vec3f>& points) {
  for (std::size_t s = 0; s < groom.strandCount(); ++s) {
    const Vec3f root = points[groom.firstPoint[s]];
    for (std::uint32_t i = groom.firstPoint[s]; i < groom.firstPoint[s + 1]; ++i)
      points[i] = root + (points[i] - root) * factor;
  }
}

TEST_F(BenchmarkTest, StiffStrandsKeepTheirShapeInEveryCase) {
  for (const BenchmarkCase& of : benchmarkCases()) {
    for (const char* file : {"scene.toml", "rest.obj", "rest.abc", "carried.usdc", "carried.abc"})
      EXPECT_TRUE(fs::exists(folder_ / of.name / file)) << of.name << '/' << file;
    fs::copy_file(folder_ / of.name / "carried.abc", folder_ / of.name / "hair.abc");
  }
  EXPECT_TRUE(fs::exists(folder_ / "walk/body.obj"));
  const auto scores = scoreBenchmark(folder_);
  ASSERT_TRUE(scores) << scores.error().message;
  ASSERT_EQ(scores->cases.size(), benchmarkCases().size());
  for (const BenchmarkScore& score : scores->cases) {
    SCOPED_TRACE(score.name);
    EXPECT_EQ(score.problem, "");
    EXPECT_EQ(score.frameCount, score.expectedCount);
    EXPECT_LT(score.roots, 1e-6);
    EXPECT_LT(score.stretch, 1e-4);
    EXPECT_NEAR(score.droop, 0, 1e-5);
    EXPECT_NEAR(score.turns, 1, 1e-3);
    EXPECT_EQ(score.depth.has_value(), score.name == "walk");
    if (score.depth) {
      EXPECT_LT(*score.depth, 1e-4);
    }
    // Stiff curls are pushed into each other.
    const bool arePushed = score.name == "two_curls";
    if (score.crossings) {
      EXPECT_EQ(*score.crossings > 0, arePushed) << *score.crossings;
      EXPECT_EQ(*score.overlap > 1e-3, arePushed) << *score.overlap;
    }
  }
  ASSERT_TRUE(scores->resolution);
  EXPECT_LT(*scores->resolution, 1e-5);
}

TEST_F(BenchmarkTest, WhatIsWrongShows) {
  simulate("hang_32", [](int, const Groom&, std::vector<Vec3f>& points) {
    for (Vec3f& p : points) p.x += 1;
  });
  const double unit = AnimationReader::open(folder_ / "hang_32/carried.usdc")->header().metresPerUnit;
  EXPECT_NEAR(scoreOf("hang_32").roots, unit, 1e-5);
  EXPECT_NEAR(scoreOf("hang_32").motion, 0, 1e-6);

  simulate("hang_32", [](int frame, const Groom& groom, std::vector<Vec3f>& points) {
    scaleStrands(groom, frame < 90 ? 1.1F : 1.05F, points);
  });
  EXPECT_NEAR(scoreOf("hang_32").stretch, 0.1, 1e-3) << "the worst of all frames";
  EXPECT_GT(scoreOf("hang_32").droop, 0.005) << "the last frame's";
  EXPECT_NEAR(scoreOf("hang_32").roots, 0, 1e-6);

  // Each hair passes through its neighbour and back.
  simulate("release", [](int frame, const Groom& groom, std::vector<Vec3f>& points) {
    for (std::size_t s = 0; frame == 20 && s < groom.strandCount(); s += 2) {
      const Vec3f beyond = (points[groom.firstPoint[s + 1]] - points[groom.firstPoint[s]]) * 1.5F;
      for (std::uint32_t i = groom.firstPoint[s] + 4; i < groom.firstPoint[s + 1]; ++i)
        points[i] = points[i] + beyond;
    }
  });
  EXPECT_GT(*scoreOf("release").crossings, 1);
}

TEST_F(BenchmarkTest, AFileThatDoesNotFitIsAProblem) {
  EXPECT_NE(scoreBenchmark(folder_).error().message.find("no case has a run yet"), std::string::npos);
  const auto keep = [](int, const Groom&, std::vector<Vec3f>&) {};
  simulate("hang_8", keep, 0);
  EXPECT_EQ(scoreOf("hang_8").problem, "") << "the rest in front";
  simulate("hang_8", keep, 1, 3);
  EXPECT_NE(scoreOf("hang_8").problem.find("93 frames; expected 96"), std::string::npos)
      << scoreOf("hang_8").problem;
  EXPECT_NE(scoreOf("hang_16").problem.find("no hair.usda"), std::string::npos) << scoreOf("hang_16").problem;
  fs::copy_file(folder_ / "hang_16/carried.usdc", folder_ / "hang_64/hair.usdc");
  EXPECT_NE(scoreOf("hang_64").problem.find("1 strands of 16 points in all; expected 1 of 64"),
            std::string::npos)
      << scoreOf("hang_64").problem;
  const auto none = scoreBenchmark(folder_ / "nothing");
  ASSERT_FALSE(none);
  EXPECT_NE(none.error().message.find("--write` writes the cases"), std::string::npos)
      << none.error().message;
}

TEST_F(BenchmarkTest, TheProgramPrintsALineACase) {
  fs::copy_file(folder_ / "shake/carried.usdc", folder_ / "shake/hair.usdc");
  const test::ProgramResult text = test::runProgram(folder_, {"measure", "--benchmark", "."});
  EXPECT_EQ(text.exitCode, 0) << text.err;
  for (const char* part : {"roots mm", "shake ", "no hair.usda", "tips - mm apart"})
    EXPECT_NE(text.out.find(part), std::string::npos) << part << " in\n" << text.out;
  const test::ProgramResult both =
      test::runProgram(folder_, {"measure", "shake/rest.obj", "--benchmark", "."});
  EXPECT_EQ(both.exitCode, 2) << both.out;
}

}  // namespace
}  // namespace ringlet::program
