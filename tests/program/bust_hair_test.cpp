// Full hair on a bust that bends, written by `simulate` and by `convert`: where the bust's points are then,
// hairs that follow stay out of it as their strands do.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "ringlet/measure/body_watch.h"
#include "ringlet/scenes/file/scene_file.h"
#include "ringlet/scenes/frames/scene_frames.h"
#include "ringlet/scenes/load/load_scene.h"
#include "tests/program/run_program.h"
#include "tests/support/strict_usd.h"
#include "tests/support/test_support.h"

namespace ringlet::bust_hair_test {
namespace {

using test::runProgram;
using test::scratchFolder;

constexpr int kFrames = 16;

// The deepest point of the file's hairs in the scene's body, of those that had been outside [m].
double deepestOf(const std::filesystem::path& path, const LoadedScene& scene) {
  const test::UsdFile file = test::readUsd(path);
  const double unit = scene.groom.metresPerUnit;
  Groom hairs;
  hairs.metresPerUnit = unit;
  hairs.points = file.points.begin()->second;
  for (std::size_t first = 0; const int count : file.counts) {
    hairs.firstPoint.push_back(static_cast<std::uint32_t>(first += static_cast<std::size_t>(count)));
  }
  BodyWatch watch(hairs, scene.bodies, 1);
  const SceneFrames frames(scene);
  for (const auto& [frame, points] : file.points) {
    std::vector<Vec3f> metres;
    for (const Vec3f& p : points) metres.push_back(p * static_cast<float>(unit));
    std::vector<std::vector<Vec3d>> bent = frames.bodyPointsAt(frame);
    const std::vector<BodyPose> poses = frames.bodiesAt(frame);
    for (Vec3d& p : bent[0])
      p = poses[scene.moving[0].body].position + rotate(poses[scene.moving[0].body].rotation, p);
    const std::vector<std::span<const Vec3d>> views(bent.begin(), bent.end());
    watch.look(metres, HeadPose{}, poses, views);
  }
  return watch.numbers().deepest;
}

TEST(BustHair, FollowingHairsStayOutOfABodyThatBends) {
  const auto folder = scratchFolder("bust_hair");
  const std::string frames = "simulation.frames=" + std::to_string(kFrames);
  ASSERT_EQ(runProgram(folder, {"scene", "bust", "--write", "bust.toml", "--strands", "40", "--set", frames,
                                "--set", "contacts.on=false"})
                .exitCode,
            0);
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"simulate", "bust.toml", "-o", "full", "--hairs", "600", "--no-sheet"},
        {"simulate", "bust.toml", "-o", "strands", "--no-sheet"},
        {"convert", "strands/hair.usda", "full.usda", "--hairs", "600", "--scene", "bust.toml"}}) {
    const auto ran = runProgram(folder, command);
    ASSERT_EQ(ran.exitCode, 0) << ran.err;
  }
  const auto file = readScene(folder / "bust.toml");
  ASSERT_TRUE(file) << file.error().message;
  const auto scene = loadScene(*file);
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_LT(deepestOf(folder / "full/hair.usda", *scene), 1.5e-3);
  EXPECT_LT(deepestOf(folder / "full.usda", *scene), 1.5e-3);
}

}  // namespace
}  // namespace ringlet::bust_hair_test
