// Frames of several heads in one submission: each moves as if it were alone.
#include <gtest/gtest.h>

#include <vector>

#include "parity/tolerances.h"
#include "ringlet/gpu/device.h"
#include "ringlet/solver/diagnostics.h"
#include "ringlet/solver/hair_frames.h"
#include "tests/kernels/sample_hairs.h"
#include "tests/support/gpu_test.h"
#include "tests/support/test_support.h"

namespace ringlet::test::hair_frames_test {
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
    const auto before = Diagnostics(crowd.alone[k]).memory().contactLists;
    ASSERT_TRUE(crowd.alone[k].stepFrame(poses[k]));
    if (Diagnostics(crowd.alone[k]).memory().contactLists > before) ++grown;
  }
  EXPECT_GT(grown, 0u) << "all lists had room";
  expectEqual(crowd);
}

// What heads of one asset are like that a dispatch can step together, and that one must not.
struct RowOfHeads {
  std::vector<Head> heads;
  std::vector<Simulation> hair;

  RowOfHeads(const ComputeDevice& device, const Hair& kind) {
    const auto asset = build(device, kind);
    EXPECT_TRUE(asset) << asset.error().message;
    for (int k = 0; k < kCount; ++k) {
      heads.push_back({Vec3d{0.3 * k - 0.7, 0.2, -0.1 * k}, k == 5 ? 1.0 : 0.0});
      hair.push_back(*make(*asset, kind, heads.back()));
    }
    Settings heavy = hair[2].settings();
    heavy.gravity = heavy.gravity * 2.0;
    EXPECT_TRUE(hair[2].setSettings(heavy));
    Material stiff = hair[4].material();
    stiff.bendStiffness *= 3;
    EXPECT_TRUE(hair[4].setMaterial(stiff));
    hair[6] = *make(*asset, kind, heads[6]);  // its place is behind the others
    hair[7] = *make(*asset, kind, heads[7]);  // in the place that 6 left
  }
  static constexpr int kCount = 9;
};

// Nine heads in two rows and a piece, handed over in no order: with other gravity, another material and roots
// that shift among them. Each is where it is alone, and where hair of one head is.
TEST_F(HairFramesTest, HeadsOfARowStepAsIfAlone) {
  using Form = KernelChoice::Form;
  Hair kind = hairs().front();
  for (const KernelChoice& choice : {KernelChoice{}, KernelChoice{Form::lanes, 8, 8},
                                     KernelChoice{Form::memory}, KernelChoice{Form::serial}}) {
    kind.kernel = choice;
    RowOfHeads single(device(), kind);
    kind.kernel.heads = 4;
    RowOfHeads together(device(), kind), alone(device(), kind);
    SCOPED_TRACE(Diagnostics(together.hair[0]).kernels());
    for (int frame = 0; frame < 3; ++frame) {
      SCOPED_TRACE(frame);
      std::vector<std::vector<HeadPose>> poses;
      for (const Head& head : together.heads) poses.push_back(posesOf(kind, head, frame));
      std::vector<HairFrame> frames;
      for (const int k : {3, 0, 8, 7, 1, 2, 6, 5, 4}) frames.push_back({&together.hair[k], poses[k]});
      const Status status = stepFrames(frames);
      ASSERT_TRUE(status) << status.error().message;
      for (int k = 0; k < RowOfHeads::kCount; ++k) {
        SCOPED_TRACE(k);
        ASSERT_TRUE(alone.hair[k].stepFrame(poses[k]));
        ASSERT_TRUE(single.hair[k].stepFrame(poses[k]));
        EXPECT_EQ(together.hair[k].framePositions(), alone.hair[k].framePositions());
        EXPECT_EQ(together.hair[k].state()->velocities, alone.hair[k].state()->velocities);
        EXPECT_LT(farthestApart(*together.hair[k].positions(), *single.hair[k].positions()),
                  parity::kOneFrame * 0.25)
            << "strands of 25 cm";
        EXPECT_NEAR(together.hair[k].report()->maxEdgeStretch, single.hair[k].report()->maxEdgeStretch, 1e-5);
      }
    }
  }
}

// Of a row and of hair with dispatches of its own, some heads are cut.
TEST_F(HairFramesTest, HeadsThatAreCutStepAsIfAlone) {
  Hair kind = hairs().front();
  kind.kernel.heads = 4;
  RowOfHeads together(device(), kind), alone(device(), kind);
  Crowd crowd = makeCrowd(device());
  const std::vector<StrandCut> cuts{{0, 5}, {1, 3}};
  for (const int k : {1, 2, 8}) {
    ASSERT_TRUE(together.hair[k].cut(cuts));
    ASSERT_TRUE(alone.hair[k].cut(cuts));
  }
  for (std::size_t k = 0; k < crowd.hairs.size(); k += 2) {
    if (crowd.hairs[k].settings.integrator != Integrator::jacobi) continue;
    ASSERT_TRUE(crowd.together[k].cut(cuts));
    ASSERT_TRUE(crowd.alone[k].cut(cuts));
  }
  for (int frame = 0; frame < 3; ++frame) {
    SCOPED_TRACE(frame);
    std::vector<std::vector<HeadPose>> poses, crowdPoses;
    std::vector<HairFrame> frames;
    for (const Head& head : together.heads) poses.push_back(posesOf(kind, head, frame));
    for (std::size_t k = 0; k < crowd.hairs.size(); ++k)
      crowdPoses.push_back(posesOf(crowd.hairs[k], crowd.heads[k], frame));
    for (std::size_t k = 0; k < poses.size(); ++k) frames.push_back({&together.hair[k], poses[k]});
    for (std::size_t k = 0; k < crowdPoses.size(); ++k) frames.push_back({&crowd.together[k], crowdPoses[k]});
    const Status status = stepFrames(frames);
    ASSERT_TRUE(status) << status.error().message;
    for (std::size_t k = 0; k < poses.size(); ++k) {
      SCOPED_TRACE(k);
      ASSERT_TRUE(alone.hair[k].stepFrame(poses[k]));
      EXPECT_EQ(*together.hair[k].positions(), *alone.hair[k].positions());
      EXPECT_EQ(together.hair[k].state()->velocities, alone.hair[k].state()->velocities);
    }
    for (std::size_t k = 0; k < crowdPoses.size(); ++k) ASSERT_TRUE(crowd.alone[k].stepFrame(crowdPoses[k]));
    expectEqual(crowd);
  }
}

// Counts vkCmdDispatch on its way to the driver.
class CountedDispatches {
 public:
  explicit CountedDispatches(const gpu::Device& device) : table_(const_cast<VolkDeviceTable&>(device.vk())) {
    driver = table_.vkCmdDispatch;
    count = 0;
    table_.vkCmdDispatch = [](VkCommandBuffer commands, std::uint32_t x, std::uint32_t y, std::uint32_t z) {
      ++count;
      driver(commands, x, y, z);
    };
  }
  ~CountedDispatches() { table_.vkCmdDispatch = driver; }

  static inline PFN_vkCmdDispatch driver = nullptr;
  static inline int count = 0;

 private:
  VolkDeviceTable& table_;
};

// Seven heads in rows of five: a dispatch for each row; with one head under other gravity, one for those
// before it, one for it, one for those behind it.
TEST_F(HairFramesTest, OneDispatchStepsManyHeads) {
  Hair kind = hairs().front();
  kind.groom = randomGroom(std::vector<int>(10, 20), 3);
  kind.kernel.heads = 5;
  const auto asset = build(device(), kind);
  std::vector<Simulation> heads;
  for (int k = 0; k < 7; ++k) heads.push_back(*make(*asset, kind, kHeads[0]));
  const auto dispatchesOf = [&](int frame) {
    const CountedDispatches counted(gpu());
    const std::vector<HeadPose> poses = posesOf(kind, kHeads[0], frame);
    std::vector<HairFrame> frames;
    for (Simulation& head : heads) frames.push_back({&head, poses});
    EXPECT_TRUE(stepFrames(frames));
    return CountedDispatches::count;
  };
  EXPECT_EQ(dispatchesOf(0), 2);
  heads.pop_back();
  heads.push_back(*make(*asset, kind, kHeads[0]));  // in the place that is free again
  EXPECT_EQ(dispatchesOf(1), 2);
  Settings heavy = heads[2].settings();
  heavy.gravity = heavy.gravity * 2.0;
  ASSERT_TRUE(heads[2].setSettings(heavy));
  EXPECT_EQ(dispatchesOf(2), 4);
}

// Poses of heads are read as texels: a row has as many heads as the device sees poses of, and a head whose
// positions it sees as texels alone has them seen in a row too.
TEST_F(HairFramesTest, ARowIsNoLongerThanTexelsReach) {
  struct Case {
    std::uint64_t texels;
    int particles, dispatches;
  };
  Hair kind = hairs().front();
  kind.kernel.heads = 5;
  const std::vector<HeadPose> poses = posesOf(kind, kHeads[0], 0);
  for (const Case& few :
       {Case{16, 20, 5}, Case{2 * 1100, 20, 3}, Case{5 * 1100, 20, 1}, Case{5 * 1100, 200, 3}}) {
    SCOPED_TRACE(few.texels);
    SCOPED_TRACE(few.particles);
    const auto opened = gpu::Device::open("", {.mostTexelRecords = few.texels});
    ASSERT_TRUE(opened) << opened.error().message;
    kind.groom = randomGroom(std::vector<int>(10, few.particles), 3);
    const auto asset = build(ComputeDevice::over(*opened), kind);
    ASSERT_TRUE(asset) << asset.error().message;
    std::vector<Simulation> heads;
    for (int k = 0; k < 5; ++k) heads.push_back(*make(*asset, kind, kHeads[0]));
    std::vector<HairFrame> frames;
    for (Simulation& head : heads) frames.push_back({&head, poses});
    const CountedDispatches counted(**opened);
    ASSERT_TRUE(stepFrames(frames));
    EXPECT_EQ(CountedDispatches::count, few.dispatches);
    for (const Simulation& head : heads) EXPECT_TRUE(head.framePositions() == heads[0].framePositions());
  }
}

// One that sleeps between two that move is left as it is.
TEST_F(HairFramesTest, ASleeperOfARowIsLeftAlone) {
  Hair kind = hairs().front();
  kind.groom = randomGroom(std::vector<int>(10, 20), 3);
  kind.kernel.heads = 3;
  kind.settings.sleepSpeed = 0.5;
  const Head heads[] = {{{1, 0, 0}}, {{0, 0, 0}}, {{0, 0.5, 0}}};
  const auto asset = build(device(), kind);
  std::vector<Simulation> together, alone;
  for (const Head& head : heads) together.push_back(*make(*asset, kind, head));
  for (const Head& head : heads) alone.push_back(*make(*asset, kind, head));
  int dispatches = 0;
  for (int frame = 0; frame < 30; ++frame) {
    SCOPED_TRACE(frame);
    const CountedDispatches counted(gpu());
    std::vector<std::vector<HeadPose>> poses;
    std::vector<HairFrame> frames;
    for (int k = 0; k < 3; ++k) poses.push_back(posesOf(kind, heads[k], frame));
    for (int k = 0; k < 3; ++k) frames.push_back({&together[k], poses[k]});
    ASSERT_TRUE(stepFrames(frames));
    dispatches = CountedDispatches::count;
    for (int k = 0; k < 3; ++k) {
      ASSERT_TRUE(alone[k].stepFrame(poses[k]));
      EXPECT_EQ(together[k].framePositions(), alone[k].framePositions()) << k;
    }
  }
  EXPECT_EQ(dispatches, 2) << "one for each that moves";
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
}  // namespace ringlet::test::hair_frames_test
