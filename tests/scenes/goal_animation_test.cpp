// Goals from files: animations in every format that is read, and grooms in another pose.
#include "ringlet/scenes/load/goal_animation.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "ringlet/groom/generate.h"
#include "ringlet/output/animation_writer.h"
#include "ringlet/output/groom_writer.h"
#include "ringlet/scenes/load/load_scene.h"
#include "tests/support/test_support.h"

namespace ringlet::goal_animation_test {
namespace {

constexpr int kFrames = 5;
constexpr double kFramesPerSecond = 10;

Groom swatch() {
  SwatchParameters parameters;
  parameters.curl.particleCount = 6;
  parameters.columnCount = 2, parameters.rowCount = 1;
  return *makeSwatch(parameters);
}

// Frame k: the groom, k decimetres along X [file unit].
std::vector<Vec3f> frameOf(const Groom& groom, int frame) {
  std::vector<Vec3f> points = groom.points;
  for (Vec3f& p : points) p.x += static_cast<float>(0.1 * frame / groom.metresPerUnit);
  return points;
}

void writeAnimation(const std::filesystem::path& path, const Groom& groom) {
  auto writer = animationFormatOf(path)->resume(
      path, groom,
      {.framesPerSecond = kFramesPerSecond, .metresPerUnit = groom.metresPerUnit, .frameCount = kFrames}, 0);
  ASSERT_TRUE(writer) << writer.error().message;
  for (int k = 1; k <= kFrames; ++k) ASSERT_TRUE((*writer)->addFrame(frameOf(groom, k)));
  ASSERT_TRUE((*writer)->finish());
}

class GoalAnimations : public testing::TestWithParam<const char*> {
 protected:
  std::filesystem::path folder_ = test::scratchFolder(fmt::format("goal_animation_{}", GetParam() + 1));
  std::filesystem::path file() const { return folder_ / fmt::format("pose{}", GetParam()); }
};

// At any times in any order: seeks, repeats, goes back.
TEST_P(GoalAnimations, StandWhereTheirFramesDo) {
  const Groom groom = swatch();
  writeAnimation(file(), groom);
  const auto opened = GoalAnimation::open(file(), groom, {.upIsZ = false});
  ASSERT_TRUE(opened) << opened.error().message;
  const HeadPose head{{1, 2, 3}, fromRotationVector(Vec3d{0.2, 0.5, -0.1})};
  for (const double t : {-1.0, 0.0, 0.1, 0.15, 0.2, 0.25, 0.45, 0.5, 7.0, 0.3, 0.12, 0.1, 0.5, 0.05}) {
    const auto places = (*opened)->placesAt(t, head);
    ASSERT_TRUE(places) << places.error().message;
    const double way = 0.1 * std::clamp(t * kFramesPerSecond, 1.0, double(kFrames));
    for (std::size_t i = 0; i < groom.points.size(); ++i) {
      const Vec3d world = Vec3d(groom.points[i]) * groom.metresPerUnit + Vec3d{way, 0, 0};
      const Vec3d found = head.position + rotate(head.rotation, Vec3d((*places)[i]));
      ASSERT_LT(length(found - world), 2e-6) << t;
    }
  }
}

TEST_P(GoalAnimations, AreOfTheSameStrands) {
  const Groom groom = swatch();
  writeAnimation(file(), groom);
  Groom other = groom;
  other.firstPoint = {0, 5, 12};
  const auto refused = GoalAnimation::open(file(), other, {.upIsZ = false});
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("expected the same strands"), std::string::npos);
  EXPECT_FALSE(GoalAnimation::open(file(), groom, {.upIsZ = true})) << "another up axis";
  EXPECT_FALSE(GoalAnimation::open(folder_ / fmt::format("none{}", GetParam()), groom, {.upIsZ = false}));
}

// Another program's file, which states neither rate nor unit nor axis.
TEST(GoalAnimation, OfAPointCacheIsOfTheGroom) {
  const auto folder = test::scratchFolder("goal_cache");
  const Groom groom = swatch();
  writeAnimation(folder / "hair.pc2", groom);
  const auto opened = GoalAnimation::open(
      folder / "hair.pc2", groom,
      {.metresPerUnit = groom.metresPerUnit, .upIsZ = true, .framesPerSecond = kFramesPerSecond});
  ASSERT_TRUE(opened) << opened.error().message;
  const auto places = (*opened)->placesAt(0.25, HeadPose{});
  ASSERT_TRUE(places) << places.error().message;
  for (std::size_t i = 0; i < groom.points.size(); ++i) {
    const Vec3d world = Vec3d(groom.points[i]) * groom.metresPerUnit + Vec3d{0.25, 0, 0};
    ASSERT_LT(length(Vec3d((*places)[i]) - world), 2e-6);
  }
}

INSTANTIATE_TEST_SUITE_P(Formats, GoalAnimations, testing::ValuesIn([] {
                           std::vector<const char*> read;
                           for (const AnimationFormat& format : animationFormats())
                             if (format.isRead) read.push_back(format.extension);
                           return read;
                         }()),
                         [](const auto& of) { return std::string(of.param + 1); });

// [goal] file of a scene: a groom is placed as the scene's own.
TEST(GoalFiles, AreAnimationsOrPoses) {
  const auto folder = test::scratchFolder("goal_files");
  const Groom groom = swatch();
  Groom posed = groom;
  for (Vec3f& p : posed.points) p.y *= 0.5f;
  ASSERT_TRUE(writeGroom(folder / "groom.obj", groom));
  ASSERT_TRUE(writeGroom(folder / "pose.obj", posed));
  writeAnimation(folder / "pose.rgc", groom);
  const auto loaded = [&](const std::string& goal) {
    auto scene = parseScene(
        "[groom]\nfile = \"groom.obj\"\nscale = 2\n[goal]\nstrength = 3\nfile = \"" + goal + "\"\n",
        "scene.toml", folder);
    EXPECT_TRUE(scene) << scene.error().message;
    EXPECT_NE(sceneText(*scene, folder).find("file = \"" + goal + "\""), std::string::npos);
    return loadScene(*scene);
  };
  const auto still = loaded("pose.obj");
  ASSERT_TRUE(still) << still.error().message;
  const auto pose = still->forces.goalsAt(0, {}, still->settings.goal, nullptr);
  ASSERT_TRUE(pose && still->forces.haveGoals());
  for (std::size_t i = 0; i < posed.points.size(); ++i) {
    const Vec3d there = Vec3d(posed.points[i]) * (2 * posed.metresPerUnit);
    EXPECT_LT(length(Vec3d(pose->places[i]) - there), 1e-6);
    EXPECT_EQ(pose->strengths[i], 3);
  }
  const auto moving = loaded("pose.rgc");
  ASSERT_TRUE(moving) << moving.error().message;
  const auto now = moving->forces.goalsAt(0.5, {}, moving->settings.goal, nullptr);
  ASSERT_TRUE(now);
  EXPECT_NEAR(now->places[0].x, groom.points[0].x * groom.metresPerUnit + 0.5, 1e-6);
  // Other strands, and no file.
  ASSERT_TRUE(writeGroom(folder / "curl.obj", *makeCurl()));
  for (const char* wrong : {"curl.obj", "none.obj", "none.rgc"}) {
    const auto refused = loaded(wrong);
    ASSERT_FALSE(refused) << wrong;
    EXPECT_EQ(refused.error().message.rfind("the goal: ", 0), 0u) << refused.error().message;
  }
}

}  // namespace
}  // namespace ringlet::goal_animation_test
