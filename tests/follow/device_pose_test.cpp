// Hair on the device where what follows or draws it wants it: the same bits as from the host.
#include "ringlet/follow/device_pose.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <optional>
#include <vector>

#include "layout/types.h"
#include "ringlet/follow/follow_stage.h"
#include "ringlet/gpu/device_buffers.h"
#include "ringlet/gpu/recorder.h"
#include "ringlet/groom/generate.h"
#include "ringlet/render/strand_points.h"
#include "ringlet/solver/diagnostics.h"
#include "ringlet/solver/simulation.h"
#include "tests/support/gpu_test.h"

namespace ringlet::test::device_pose_test {

static bool operator==(const layout::uvec4& a, const layout::uvec4& b) {
  return a.x == b.x && a.y == b.y && a.z == b.z && a.w == b.w;
}

namespace {

const HeadPose kTurned{{0.02, -0.01, 0.03}, normalized(Quatd{0.1, -0.2, 0.05, 1}), 0};

// A head of curls, the last strand of which is too short to be simulated, after some frames on a head that
// turns.
struct Moved {
  Groom groom;
  std::vector<Vec3d> rest;
  std::optional<Simulation> hair;
  std::vector<Vec3f> positions;

  std::vector<PoseSource> sources(const std::vector<DevicePositions>& parts) const {
    std::vector<PoseSource> all;
    for (const DevicePositions& part : parts) all.push_back({*part.own, part.particles});
    return all;
  }
};

Moved movedHair(const ComputeDevice& device, std::uint64_t mostBufferBytes = 0) {
  Moved moved;
  moved.groom = *makeHead({.curl = {.turns = 3, .particleCount = 20}, .strandCount = 70});
  Groom& groom = moved.groom;
  const Vec3f root = groom.strand(3).front();
  for (const double along : {0.0, 1e-5, 2e-5}) groom.points.push_back(root + Vec3f(Vec3d{along, 0, 0}));
  groom.firstPoint.push_back(static_cast<std::uint32_t>(groom.points.size()));
  for (const Vec3f& p : groom.points) moved.rest.push_back(Vec3d(p) * groom.metresPerUnit);
  auto hair =
      Simulation::create(device, groom, {}, {}, {.readsBack = false}, {.mostBufferBytes = mostBufferBytes});
  EXPECT_TRUE(hair) << hair.error().message;
  for (int frame = 0; frame < 3; ++frame) {
    EXPECT_TRUE(hair->stepFrame(kTurned));
  }
  moved.positions = *hair->positions();
  moved.hair.emplace(std::move(*hair));
  return moved;
}

std::vector<layout::uvec4> run(gpu::Device& device, const DevicePose& pose, Quatd head,
                               const gpu::Buffer& target) {
  auto recorder = gpu::Recorder::create(device, "pose");
  EXPECT_TRUE(recorder->begin());
  pose.record(*recorder, head);
  EXPECT_TRUE(recorder->submitAndWait());
  return *downloadAll<layout::uvec4>(target, static_cast<std::size_t>(target.bytes() / 16));
}

using DevicePoseTest = GpuTest;

TEST_F(DevicePoseTest, GuidesAreThoseThatTheHostHandsOver) {
  const Moved moved = movedHair(device());
  ASSERT_EQ(Diagnostics(*moved.hair).rigidStrandCount(), 1u);
  std::vector<GuideRest> guides;
  for (std::size_t s = 0; s < moved.groom.strandCount(); ++s) {
    const auto first = moved.rest.begin() + moved.groom.firstPoint[s];
    guides.push_back(restOfGuide(
        std::vector<Vec3d>(first, first + static_cast<std::ptrdiff_t>(moved.groom.strand(s).size()))));
  }
  const auto hairs = *planHairs(guides, {.hairCount = 100});
  auto stage = FollowStage::create(gpu(), guides, hairs);
  ASSERT_TRUE(stage) << stage.error().message;
  const std::vector<Vec3d> asDoubles(moved.positions.begin(), moved.positions.end());
  const std::vector<std::uint32_t> cutBeyond{2, moved.groom.firstPoint[1] + 4};
  ASSERT_TRUE(stage->setPose(asDoubles, {}, cutBeyond));
  const auto expected = *downloadAll<layout::uvec4>(stage->pose(), moved.rest.size());
  ASSERT_TRUE(stage->setPose(std::vector<Vec3d>(moved.rest.size())));

  const auto parts = moved.hair->devicePositions();
  auto pose = DevicePose::create(
      gpu(), moved.sources(parts),
      {.rest = moved.rest, .firstPoint = moved.groom.firstPoint, .cutBeyond = cutBeyond}, stage->pose());
  ASSERT_TRUE(pose) << pose.error().message;
  const auto found = run(gpu(), *pose, moved.hair->head().rotation, stage->pose());
  const std::size_t simulated = moved.groom.firstPoint[moved.groom.strandCount() - 1];
  for (std::size_t i = 0; i < simulated; ++i) ASSERT_TRUE(found[i] == expected[i]) << i;
  for (std::size_t i = simulated; i < found.size(); ++i) {
    const Vec3d p{std::bit_cast<float>(found[i].x), std::bit_cast<float>(found[i].y),
                  std::bit_cast<float>(found[i].z)};
    EXPECT_LT(length(p - asDoubles[i]), 1e-7) << "a strand that the head carries, point " << i;
  }
}

TEST_F(DevicePoseTest, StrandsAreThoseThatTheHostHandsOverInChunksToo) {
  for (const std::uint64_t mostBytes : {0, 8192}) {
    const Moved moved = movedHair(device(), mostBytes);
    const auto parts = moved.hair->devicePositions();
    EXPECT_EQ(parts.size() > 1, mostBytes > 0);
    auto strands = StrandPoints::create(gpu(), moved.groom.firstPoint);
    ASSERT_TRUE(strands);
    const std::vector<std::uint32_t> cutBeyond{2, moved.groom.firstPoint[1] + 4};
    ASSERT_TRUE(strands->setPose(moved.positions, 1, cutBeyond));
    const auto expected = *downloadAll<layout::uvec4>(strands->points(), moved.rest.size());
    ASSERT_TRUE(strands->setPose(std::vector<Vec3f>(moved.rest.size()), 1));
    auto pose = DevicePose::create(gpu(), moved.sources(parts),
                                   {.rest = moved.rest,
                                    .firstPoint = moved.groom.firstPoint,
                                    .cutBeyond = cutBeyond,
                                    .tag = PoseTag::strand},
                                   strands->points());
    ASSERT_TRUE(pose) << pose.error().message;
    const auto found = run(gpu(), *pose, moved.hair->head().rotation, strands->points());
    const std::size_t simulated = moved.groom.firstPoint[moved.groom.strandCount() - 1];
    for (std::size_t i = 0; i < simulated; ++i) ASSERT_TRUE(found[i] == expected[i]) << i;
    for (std::size_t i = simulated; i < found.size(); ++i) EXPECT_EQ(found[i].w, expected[i].w);
  }
}

TEST_F(DevicePoseTest, TheBoxIsAboutAllPoints) {
  const Moved moved = movedHair(device());
  const auto parts = moved.hair->devicePositions();
  auto strands = StrandPoints::create(gpu(), moved.groom.firstPoint);
  ASSERT_TRUE(strands);
  auto pose = DevicePose::create(
      gpu(), moved.sources(parts),
      {.rest = moved.rest, .firstPoint = moved.groom.firstPoint, .tag = PoseTag::strand}, strands->points());
  ASSERT_TRUE(pose) << pose.error().message;
  Vec3d low{1e9, 1e9, 1e9}, high = low * -1.0;
  for (const Vec3f& p : moved.positions) {
    low = {std::min<double>(low.x, p.x), std::min<double>(low.y, p.y), std::min<double>(low.z, p.z)};
    high = {std::max<double>(high.x, p.x), std::max<double>(high.y, p.y), std::max<double>(high.z, p.z)};
  }
  for (int again = 0; again < 2; ++again) {
    (void)run(gpu(), *pose, moved.hair->head().rotation, strands->points());
    EXPECT_LT(length(pose->box().low - low), 1e-7);
    EXPECT_LT(length(pose->box().high - high), 1e-7);
  }
}

}  // namespace
}  // namespace ringlet::test::device_pose_test
