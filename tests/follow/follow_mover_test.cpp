// Mirrors ringlet/pictures/follow_mover.h: hairs are where their strands are, whatever unit the groom is in.
#include "ringlet/pictures/follow_mover.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "parity/sample_bodies.h"
#include "ringlet/groom/generate.h"
#include "ringlet/pictures/full_hair.h"
#include "tests/support/gpu_test.h"

namespace ringlet::test::follow_mover_test {
namespace {

class FollowMoverTest : public GpuTest {};

TEST_F(FollowMoverTest, ItsHairsAreInTheGroomsUnit) {
  HeadParameters parameters{.strandCount = 40};
  parameters.curl.particleCount = 24;
  const Groom made = *makeHead(parameters);
  std::vector<Vec3d> expected;  // [m]
  for (const double unit : {1.0, 0.01, 0.0254}) {
    SCOPED_TRACE(unit);
    Groom groom = made;
    groom.metresPerUnit = unit;
    for (Vec3f& p : groom.points) p = static_cast<Vec3f>(Vec3d(p) * (made.metresPerUnit / unit));
    auto hair = FullHair::make(groom, unit, {.hairCount = 400}, followOn(device()));
    ASSERT_TRUE(hair) << hair.error().message;
    std::vector<Vec3f> pose = groom.points;
    for (Vec3f& p : pose) p.x += static_cast<float>(0.1 / unit);  // all of it to the side, by 10 cm
    const Status moved = hair->follow({pose});
    ASSERT_TRUE(moved) << moved.error().message;
    std::vector<Vec3d> found;
    for (const Vec3f& p : hair->groom().points) found.push_back(Vec3d(p) * unit);
    const std::vector<std::uint32_t> strandOf = hair->strandOf();
    for (std::size_t h = 0; h < hair->groom().strandCount(); ++h) {
      const Vec3d root = Vec3d(hair->groom().strand(h).front()) * unit;
      const Vec3d strand = Vec3d(pose[groom.firstPoint[strandOf[h]]]) * unit;
      ASSERT_LT(length(root - strand), 0.1) << h;
    }
    if (expected.empty()) expected = found;
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) ASSERT_LT(length(found[i] - expected[i]), 1e-5) << i;
  }
}

// Without poses bodies are left out, as where hairs are made, at rest; with poses they are met.
TEST_F(FollowMoverTest, ItsHairsMeetBodiesThatHavePoses) {
  HeadParameters parameters{.strandCount = 40};
  parameters.curl.particleCount = 24;
  const Groom groom = *makeHead(parameters);
  const double unit = groom.metresPerUnit;
  const auto alone = FullHair::make(groom, unit, {.hairCount = 400}, followOn(device()));
  ASSERT_TRUE(alone) << alone.error().message;
  const Vec3d middle = Vec3d(groom.strand(0)[12]) * unit + Vec3d{0.03, -0.02, 0.02};
  for (const Body& body : {Body{.shape = BodyShape::sphere, .radius = 0.05}, parity::gridBall(0.05, 0.005),
                           parity::bendingBall(0.05, 0.005)}) {
    auto hair = FullHair::make(groom, unit, {.hairCount = 400}, followOn(device()), {&body, 1});
    ASSERT_TRUE(hair) << hair.error().message;
    EXPECT_EQ(hair->groom().points, alone->groom().points);
    const BodyPose pose{middle, {}};
    ASSERT_TRUE(hair->follow({.points = groom.points, .bodies = {&pose, 1}}));
    EXPECT_NE(hair->groom().points, alone->groom().points);
    ASSERT_TRUE(hair->follow({.points = groom.points}));
    EXPECT_EQ(hair->groom().points, alone->groom().points);
  }
}

}  // namespace
}  // namespace ringlet::test::follow_mover_test
