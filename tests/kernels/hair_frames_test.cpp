// Frames of several heads in one submission: each moves as if it were alone.
#include <gtest/gtest.h>

#include <vector>

#include "ringlet/solver/hair_frames.h"
#include "tests/kernels/sample_hairs.h"
#include "tests/support/gpu_test.h"

namespace ringlet::test {
namespace {

using HairFramesTest = GpuTest;

std::vector<HeadPose> posesOf(const Hair& hair, const Head& head, int frame) {
  std::vector<HeadPose> poses;
  const int steps = hair.settings.stepsPerFrame;
  for (int k = 1; k <= steps; ++k)
    poses.push_back(head.at((frame + double(k) / steps) / hair.settings.framesPerSecond));
  return poses;
}

// Every kind of hair on both heads, each once together with all others and once by itself.
struct Crowd {
  std::vector<Hair> hairs;
  std::vector<Head> heads;
  std::vector<Simulation> together, alone;
};
Crowd makeCrowd(const ComputeDevice& device) {
  Crowd crowd;
  for (const Hair& hair : hairs()) {
    const auto asset = build(device, hair);
    EXPECT_TRUE(asset) << asset.error().message;
    for (const Head& head : kHeads) {
      crowd.hairs.push_back(hair);
      crowd.heads.push_back(head);
      crowd.together.push_back(*make(*asset, hair, head));
      crowd.alone.push_back(*make(*asset, hair, head));
    }
  }
  return crowd;
}

void expectEqual(const Crowd& crowd) {
  for (std::size_t k = 0; k < crowd.hairs.size(); ++k) {
    SCOPED_TRACE(crowd.hairs[k].name);
    EXPECT_TRUE(crowd.together[k].state()->positions == crowd.alone[k].state()->positions);
    EXPECT_TRUE(crowd.together[k].state()->velocities == crowd.alone[k].state()->velocities);
    EXPECT_TRUE(crowd.together[k].framePositions() == crowd.alone[k].framePositions());
  }
}

// In the third frame every second head jumps.
TEST_F(HairFramesTest, HeadsStepTogetherAsIfAlone) {
  Crowd crowd = makeCrowd(device());
  for (int frame = 0; frame < 4; ++frame) {
    SCOPED_TRACE(frame);
    std::vector<std::vector<HeadPose>> poses;
    std::vector<HairFrame> frames;
    for (std::size_t k = 0; k < crowd.hairs.size(); ++k) {
      poses.push_back(posesOf(crowd.hairs[k], crowd.heads[k], frame));
      if (frame >= 2 && k % 2 == 0) {
        for (HeadPose& pose : poses.back()) pose.position.y += 20;
      }
    }
    for (std::size_t k = 0; k < crowd.hairs.size(); ++k) {
      frames.push_back({&crowd.together[k], poses[k]});
      ASSERT_TRUE(crowd.alone[k].stepFrame(poses[k]));
    }
    const Status status = stepFrames(frames);
    ASSERT_TRUE(status) << status.error().message;
    expectEqual(crowd);
  }
}

// Hair that was pushed together has longer lists than there is room for: some frames go on after others.
TEST_F(HairFramesTest, ListsThatGrowHoldNobodyUp) {
  Crowd crowd = makeCrowd(device());
  for (auto* simulations : {&crowd.together, &crowd.alone}) {
    for (Simulation& simulation : *simulations) {
      HairState state = *simulation.state();
      for (Vec3f& p : state.positions) p = p * 0.3f;
      ASSERT_TRUE(simulation.setState(state));
    }
  }
  std::vector<std::vector<HeadPose>> poses;
  std::vector<HairFrame> frames;
  for (std::size_t k = 0; k < crowd.hairs.size(); ++k)
    poses.push_back(posesOf(crowd.hairs[k], crowd.heads[k], 0));
  for (std::size_t k = 0; k < crowd.hairs.size(); ++k) frames.push_back({&crowd.together[k], poses[k]});
  ASSERT_TRUE(stepFrames(frames));
  std::size_t grown = 0;
  for (std::size_t k = 0; k < crowd.hairs.size(); ++k) {
    const auto before = crowd.alone[k].memory().contactLists;
    ASSERT_TRUE(crowd.alone[k].stepFrame(poses[k]));
    if (crowd.alone[k].memory().contactLists > before) ++grown;
  }
  EXPECT_GT(grown, 0u) << "all lists had room";
  expectEqual(crowd);
}

TEST_F(HairFramesTest, NoHeadsAreFine) { EXPECT_TRUE(stepFrames({})); }

TEST_F(HairFramesTest, MisuseIsTheCallersFault) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const Hair hair = hairs().front();
  auto simulation = *make(*build(device(), hair), hair, kHeads[0]);
  const std::vector<HeadPose> poses = posesOf(hair, kHeads[0], 0);
  const std::vector<HairFrame> twice{{&simulation, poses}, {&simulation, poses}};
  EXPECT_DEATH((void)stepFrames(twice), "stands twice");
  const std::vector<HairFrame> tooFew{{&simulation, std::span(poses).first(1)}};
  EXPECT_DEATH((void)stepFrames(tooFew), "one pose per outer step");
}

}  // namespace
}  // namespace ringlet::test
