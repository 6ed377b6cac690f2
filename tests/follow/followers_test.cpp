// Hairs that follow the strands of a simulation, on its device: they are where the reference says, and the
// followers of a share of a head move as a simulation of all of it does.
#include "ringlet/follow/followers.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "parity/tolerances.h"
#include "reference/follow_guide.h"
#include "ringlet/follow/guide_rest.h"
#include "ringlet/follow/level_of_detail.h"
#include "ringlet/groom/generate.h"
#include "ringlet/scene/motion.h"
#include "ringlet/solver/simulation.h"
#include "tests/support/gpu_test.h"
#include "tests/support/hairs_at_rest.h"

namespace ringlet::test::followers_test {
namespace {

class FollowersTest : public GpuTest {};

constexpr int kFrames = 18;

std::vector<Vec3f> shakenWhole(const ComputeDevice& device, const Groom& groom, const Motion& shake) {
  auto hair = Simulation::create(device, groom, {}, {});
  EXPECT_TRUE(hair);
  for (int frame = 1; frame <= kFrames; ++frame) EXPECT_TRUE(hair->stepFrame(shake.poseAt(frame / 24.0)));
  return *hair->positions();
}

std::vector<Vec3f> shakenLevel(const ComputeDevice& device, const LevelOfDetail& level, const Motion& shake) {
  auto hair = Simulation::create(device, level.groom, {}, {});
  EXPECT_TRUE(hair);
  auto followers = Followers::create(device, *hair, level.groom, level.hairs, {}, level.own);
  EXPECT_TRUE(followers) << followers.error().message;
  for (int frame = 1; frame <= kFrames; ++frame) EXPECT_TRUE(hair->stepFrame(shake.poseAt(frame / 24.0)));
  EXPECT_TRUE(followers->follow());
  EXPECT_EQ(followers->firstPoint().size(), level.hairs.size() + 1);
  return *followers->positions();
}

double meanDistance(const std::vector<Vec3f>& a, const std::vector<Vec3f>& b) {
  EXPECT_EQ(a.size(), b.size());
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += length(a[i] - b[i]);
  return sum / double(a.size());
}

TEST_F(FollowersTest, MoveAsAllHairDoes) {
  const Groom groom = *makeHead({.curl = {.particleCount = 32}, .strandCount = 200, .lockCount = 40});
  const auto shake = *motionByName("shake", {0, 1, 0});
  const std::vector<Vec3f> whole = shakenWhole(device(), groom, shake);

  std::vector<Vec3f> rigid;  // as if the head carried the hair
  const Quatd head = shake.poseAt(kFrames / 24.0).rotation;
  for (const Vec3f& p : groom.points) rigid.push_back(Vec3f(rotate(head, Vec3d(p) * groom.metresPerUnit)));
  const double moved = meanDistance(whole, rigid);
  ASSERT_GT(moved, 0.005);

  double before = 0;
  for (const double share : {1.0, 0.5, 0.2}) {
    SCOPED_TRACE(share);
    const auto level = levelOfDetail(groom, share);
    ASSERT_TRUE(level);
    const std::vector<Vec3f> found = shakenLevel(device(), *level, shake);
    const double distance = meanDistance(found, whole);
    fmt::print("{:.0f} % of strands simulated: {:.1f} % of hair's way off\n", 100 * share,
               100 * distance / moved);
    if (share == 1) {
      EXPECT_LT(distance, 1e-6);
    } else {
      EXPECT_LT(distance, moved / 3);
      EXPECT_GT(distance, before);
    }
    before = distance;
    for (std::size_t s = 0; s < groom.strandCount(); ++s) {
      const std::size_t root = groom.firstPoint[s];
      EXPECT_LT(length(found[root] - whole[root]), 1e-5f) << s;
    }
  }
}

// The device's points are those of the reference.
TEST_F(FollowersTest, AreWhereTheReferenceSays) {
  const Groom groom = *makeHead({.curl = {.turns = 4, .particleCount = 40}, .strandCount = 60});
  const auto level = levelOfDetail(groom, 0.3);
  ASSERT_TRUE(level);
  auto hair = Simulation::create(device(), level->groom, {}, {});
  ASSERT_TRUE(hair);
  const Body ball{.name = "ball", .radius = 0.06};
  const std::vector<Body> bodies{ball};
  auto followers = Followers::create(device(), *hair, level->groom, level->hairs, bodies, level->own);
  ASSERT_TRUE(followers) << followers.error().message;
  const HeadPose head{{0.05, 0.02, -0.03}, normalized(Quatd{0.1, 0.3, -0.2, 1})};
  for (int frame = 0; frame < 4; ++frame) ASSERT_TRUE(hair->stepFrame(head));
  std::size_t pushed = 0;
  for (const Vec3d way : {Vec3d{0, 0.02, 0.09}, {0.09, 0, 0}, {-0.08, 0.03, 0.02}, {0, -0.02, -0.11}}) {
    const std::vector<BodyPose> places{{head.position + way, {}}};
    ASSERT_TRUE(followers->follow(places));
    const std::vector<Vec3f> found = *followers->positions(), guides = *hair->positions();
    std::vector<BodyPose> seen = places;
    seen[0].position -= head.position;
    std::vector<reference::GuidePose> poses;
    for (std::size_t g = 0; g < level->groom.strandCount(); ++g) {
      const auto strand =
          std::span(guides).subspan(level->groom.firstPoint[g], level->groom.strand(g).size());
      const std::vector<Vec3d> rest = test::metresOf(level->groom, g);
      std::vector<Vec3d> pose;
      for (const Vec3f& p : strand) pose.push_back(Vec3d(p));
      poses.push_back(reference::poseGuide(restOfGuide(rest), pose, head.rotation));
    }
    std::size_t at = 0;
    for (std::size_t h = 0; h < level->hairs.size(); ++h) {
      const FollowHair& each = level->hairs[h];
      const auto own = level->own.of(h);
      const auto free = reference::followGuides(each, poses, {}, {}, std::nullopt, own);
      const auto kept = reference::followGuides(each, poses, bodies, seen, std::nullopt, own);
      // The frame's error turns the offset, which here is up to some centimetres.
      const double bound =
          parity::kFollowMetres * std::max(1.0, each.spread * double(length(each.offset)) / 0.04);
      for (std::size_t i = 0; i < kept.size(); ++i) {
        ASSERT_LT(length(Vec3d(found.at(at++)) - kept[i]), bound);
        pushed += length(kept[i] - free[i]) > 1e-4;
      }
    }
    EXPECT_EQ(at, found.size());
  }
  EXPECT_GT(pushed, 5u) << "the ball is where hair is";
}

}  // namespace
}  // namespace ringlet::test::followers_test
