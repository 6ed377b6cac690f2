// Heads that share an asset: each moves as if it were alone.
#include <gtest/gtest.h>

#include <optional>
#include <thread>
#include <vector>

#include "ringlet/solver/diagnostics.h"
#include "ringlet/solver/simulation.h"
#include "tests/kernels/sample_hairs.h"
#include "tests/support/gpu_test.h"

namespace ringlet::test::hair_asset_test {
namespace {

using HairAssetTest = GpuTest;

Status step(Simulation& simulation, const Hair& hair, const Head& head, int frame) {
  return simulation.stepFrame(head.at((frame + 1) / hair.settings.framesPerSecond));
}

TEST_F(HairAssetTest, HeadsMoveAsIfAlone) {
  constexpr int kFrames = 3;
  for (const Hair& hair : hairs()) {
    SCOPED_TRACE(hair.name);
    std::vector<HairState> alone;
    for (const Head& head : kHeads) {
      const auto asset = build(device(), hair);
      ASSERT_TRUE(asset) << asset.error().message;
      auto simulation = make(*asset, hair, head);
      ASSERT_TRUE(simulation) << simulation.error().message;
      for (int frame = 0; frame < kFrames; ++frame) ASSERT_TRUE(step(*simulation, hair, head, frame));
      alone.push_back(*simulation->state());
    }
    EXPECT_FALSE(alone[0].positions == alone[1].positions);

    std::optional<HairAsset> asset = *build(device(), hair);
    Simulation first = *make(*asset, hair, kHeads[0]);
    ASSERT_TRUE(step(first, hair, kHeads[0], 0));
    Simulation second = *make(*asset, hair, kHeads[1]);
    asset.reset();  // simulations hold what they need
    for (int frame = 0; frame < kFrames; ++frame) {
      ASSERT_TRUE(step(second, hair, kHeads[1], frame));
      if (frame == 0) continue;
      ASSERT_TRUE(step(first, hair, kHeads[0], frame));
    }
    EXPECT_TRUE(first.state()->positions == alone[0].positions);
    EXPECT_TRUE(first.state()->velocities == alone[0].velocities);
    EXPECT_TRUE(second.state()->positions == alone[1].positions);
    EXPECT_TRUE(second.state()->velocities == alone[1].velocities);
  }
}

// Each head on a thread of its own, from its creation on.
TEST_F(HairAssetTest, HeadsMoveOnThreadsOfTheirOwn) {
  constexpr int kFrames = 4;
  for (const Hair& hair : hairs()) {
    SCOPED_TRACE(hair.name);
    const auto asset = build(device(), hair);
    ASSERT_TRUE(asset) << asset.error().message;
    const auto endOf = [&](const Head& head) {
      auto simulation = make(*asset, hair, head);
      for (int frame = 0; simulation && frame < kFrames; ++frame) {
        if (!step(*simulation, hair, head, frame)) return HairState{};
      }
      return simulation ? *simulation->state() : HairState{};
    };
    HairState together[2];
    std::vector<std::thread> threads;
    for (int which = 0; which < 2; ++which)
      threads.emplace_back([&, which] { together[which] = endOf(kHeads[which]); });
    for (std::thread& thread : threads) thread.join();
    for (int which = 0; which < 2; ++which) {
      const HairState alone = endOf(kHeads[which]);
      ASSERT_EQ(alone.positions.size(), hair.groom.points.size());
      EXPECT_TRUE(together[which].positions == alone.positions);
      EXPECT_TRUE(together[which].velocities == alone.velocities);
    }
  }
}

TEST_F(HairAssetTest, SaysWhatIsShared) {
  for (const Hair& hair : hairs()) {
    SCOPED_TRACE(hair.name);
    const auto asset = build(device(), hair);
    ASSERT_TRUE(asset) << asset.error().message;
    EXPECT_EQ(asset->strandCount(), hair.groom.strandCount());
    EXPECT_EQ(asset->particleCount(), hair.groom.points.size());
    const std::uint64_t places = device().gpu().properties().isCpu ? 0 : 4;
    const std::uint64_t ofParticle =
        places + (hair.settings.integrator == Integrator::paper ? 32 : 64);  // profiles
    const std::uint64_t particles = ofParticle * hair.groom.points.size(),
                        strands = 112 * hair.groom.strandCount();
    EXPECT_EQ(Diagnostics(*make(*asset, hair, kHeads[0])).memory().shared, particles + strands);
    EXPECT_EQ(Diagnostics(*make(*asset, hair, kHeads[1])).memory().shared, particles)
        << "its strands are shifted";
  }
}

}  // namespace
}  // namespace ringlet::test::hair_asset_test
