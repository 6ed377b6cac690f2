// Cameras that a scene names: at a place, with the head or a joint, and of glTF files with their animation.
#include "ringlet/scenes/load/scene_camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>

#include "ringlet/motion/affine.h"
#include "ringlet/motion/file_axis.h"
#include "tests/motion/gltf_samples.h"
#include "tests/support/test_support.h"

namespace ringlet::scene_camera_test {
namespace {

constexpr double kPi = std::numbers::pi;

// A camera 2 m up on a crane: the crane turns about Y by a quarter in a second, the camera hangs 1 m out
// along X and looks down by 30 degrees; its scale does not matter. And one that is orthographic.
test::GltfBuilder crane() {
  test::GltfBuilder file;
  file.root["cameras"] = {
      {{"type", "perspective"}, {"perspective", {{"yfov", 0.6}, {"znear", 0.1}}}},
      {{"type", "orthographic"}, {"orthographic", {{"xmag", 1}, {"ymag", 1}, {"znear", 0.1}, {"zfar", 9}}}}};
  const Quatd down = fromRotationVector(Vec3d{-kPi / 6, 0, 0});
  const int shot = file.node({{"name", "Shot"},
                              {"camera", 0},
                              {"translation", {1, 0, 0}},
                              {"rotation", {down.x, down.y, down.z, down.w}},
                              {"scale", {2, 2, 2}}});
  const int flat = file.node({{"name", "Flat"}, {"camera", 1}});
  const int head = file.node({{"name", "Head"}, {"translation", {0, 1, 0}}});
  const int base = file.node({{"name", "Crane"}, {"translation", {0, 2, 0}}, {"children", {shot, flat}}});
  std::vector<double> seconds, turns, ways;
  for (int k = 0; k <= 24; ++k) {
    const Quatd turn = fromRotationVector(Vec3d{0, kPi / 2 * k / 24, 0});
    seconds.push_back(k / 24.0);
    turns.insert(turns.end(), {turn.x, turn.y, turn.z, turn.w});
    ways.insert(ways.end(), {0, 1, k / 24.0});
  }
  file.channel(0, base, "rotation", "LINEAR", seconds, turns);
  file.channel(0, head, "translation", "LINEAR", seconds, ways);
  return file;
}

SceneFile sceneOf(const std::filesystem::path& folder, const std::string& more) {
  auto scene = parseScene("groom.file = 'a.obj'\n" + more, "scene.toml", folder);
  EXPECT_TRUE(scene) << scene.error().message;
  return *scene;
}

void expectNear(Vec3d found, Vec3d expected) { EXPECT_LT(length(found - expected), 1e-6); }

Vec3d wayOf(const CameraView& view) { return normalizedOr(view.target - view.eye, {}); }

class SceneCameras : public testing::Test {
 protected:
  void SetUp() override { std::ofstream(folder_ / "crane.gltf") << crane().text(); }
  LoadedCamera loaded(const std::string& scene, const std::string& name) {
    auto camera = loadCamera(sceneOf(folder_, scene), name);
    EXPECT_TRUE(camera) << camera.error().message;
    return *camera;
  }
  std::string errorOf(const std::string& scene, const std::string& name) {
    const auto camera = loadCamera(sceneOf(folder_, scene), name);
    return camera ? "" : camera.error().message;
  }
  std::filesystem::path folder_ = test::scratchFolder("scene_cameras");
};

TEST_F(SceneCameras, StandWhereTheyAreSaidTo) {
  const CameraView view =
      loaded("[[camera]]\nname = 'a'\neye = [1, 2, 3]\ntarget = [0, 1, 0]\nfield_of_view = 90\n", "a")
          .viewAt(7, {{5, 5, 5}, {}});
  expectNear(view.eye, {1, 2, 3});
  expectNear(view.target, {0, 1, 0});
  expectNear(view.up, {0, 1, 0});
  EXPECT_NEAR(view.fieldOfView, kPi / 2, 1e-12);
  expectNear(loaded("groom.up = 'Z'\n[[camera]]\nname = 'a'\neye = [1, 2, 3]\n", "a").viewAt(0, {}).up,
             {0, 0, 1});
}

TEST_F(SceneCameras, GoWithTheHeadOrAJoint) {
  const HeadPose head{{1, 0, 0}, fromRotationVector(Vec3d{0, kPi / 2, 0})};
  const CameraView view =
      loaded("[[camera]]\nname = 'a'\neye = [0, 0, 2]\nbind = 'head'\n", "a").viewAt(0, head);
  expectNear(view.eye, {3, 0, 0});
  expectNear(view.target, {1, 0, 0});
  // The crane's own frame, half a second after its first key.
  const CameraView onCrane =
      loaded("motion.file = 'crane.gltf'\n[[camera]]\nname = 'a'\neye = [1, 0, 0]\njoint = 'Crane'\n", "a")
          .viewAt(0.5, {});
  expectNear(onCrane.eye, {std::sqrt(0.5), 2, -std::sqrt(0.5)});
  expectNear(onCrane.target, {0, 2, 0});
}

// A camera looks along its own -Z in files of another up axis too.
TEST_F(SceneCameras, OfFilesWithAnotherUpAxisLookTheSameWay) {
  const std::string up[] = {"Z", "X", "-Y"};
  for (const std::string& axis : up) {
    for (const bool upIsZ : {false, true}) {
      const FileAxis file = *fileAxisNamed(axis);
      const CameraView plain = loaded("motion.file = 'crane.gltf'\n", "Shot").viewAt(0.25, {});
      const CameraView view = loaded(std::string(upIsZ ? "groom.up = 'Z'\n" : "") +
                                         "motion.file = 'crane.gltf'\nmotion.up = '" + axis + "'\n",
                                     "Shot")
                                  .viewAt(0.25, {});
      const Affine turn = turnUp(file, upIsZ);
      expectNear(view.eye, turn(plain.eye));
      expectNear(wayOf(view), turn(wayOf(plain)));
    }
  }
}

TEST_F(SceneCameras, OfGltfFilesAreWhereTheirNodeIs) {
  for (const char* scene :
       {"motion.file = 'crane.gltf'\n", "[[camera]]\nname = 'Shot'\nfile = 'crane.gltf'\n"}) {
    const LoadedCamera camera = loaded(scene, "Shot");
    for (const double t : {0.0, 0.25, 1.0}) {
      const double angle = kPi / 2 * t;
      const CameraView view = camera.viewAt(t, {});
      expectNear(view.eye, {std::cos(angle), 2, -std::sin(angle)});
      // Down by 30 degrees from -Z, turned.
      const double level = std::cos(kPi / 6);
      expectNear(wayOf(view), {-level * std::sin(angle), -0.5, -level * std::cos(angle)});
      EXPECT_GT(view.up.y, 0.8);
      EXPECT_NEAR(view.fieldOfView, 0.6, 1e-6);
    }
  }
  // In a world whose up axis is Z: (x, y, z) is (x, -z, y).
  const CameraView up = loaded("groom.up = 'Z'\nmotion.file = 'crane.gltf'\n", "Shot").viewAt(0, {});
  expectNear(up.eye, {1, 0, 2});
  expectNear(wayOf(up), {0, std::cos(kPi / 6), -0.5});
  EXPECT_GT(up.up.z, 0.8);
  // What the head's motion adds to its file, and its unit.
  const CameraView moved =
      loaded("[motion]\nfile = 'crane.gltf'\nunit = 0.5\nstart = [0, 1, 0]\n", "Shot").viewAt(0, {});
  expectNear(moved.eye, {0.5, 2, 0});
}

TEST_F(SceneCameras, WhatIsNotThereIsSaid) {
  const std::string scene = "motion.file = 'crane.gltf'\n[[camera]]\nname = 'close'\neye = [0, 0, 1]\n";
  const std::string error = errorOf(scene, "clos");
  for (const char* part : {"no camera clos", "did you mean close?", "Shot", "Flat"})
    EXPECT_NE(error.find(part), std::string::npos) << error;
  EXPECT_NE(errorOf(scene, "Flat").find("orthographic"), std::string::npos);
  EXPECT_NE(errorOf("", "a").find("no [[camera]]"), std::string::npos);
  EXPECT_NE(errorOf("[[camera]]\nname = 'Shto'\nfile = 'crane.gltf'\n", "Shto").find("did you mean Shot?"),
            std::string::npos);
  EXPECT_NE(errorOf("[[camera]]\nname = 'a'\nfile = 'none.gltf'\n", "a").find("none.gltf"),
            std::string::npos);
}

// A camera beyond those there are, and one whose angle is none.
TEST_F(SceneCameras, BrokenFilesAreRefused) {
  for (const auto& [what, number] :
       {std::pair{"camera", 5.0}, std::pair{"yfov", 0.0}, std::pair{"yfov", 4.0}}) {
    test::GltfBuilder file = crane();
    if (std::string(what) == "camera") {
      file.root["nodes"][0]["camera"] = 5;
    } else {
      file.root["cameras"][0]["perspective"]["yfov"] = number;
    }
    std::ofstream(folder_ / "broken.gltf") << file.text();
    const std::string error = errorOf("[[camera]]\nname = 'Shot'\nfile = 'broken.gltf'\n", "Shot");
    EXPECT_NE(error.find(what), std::string::npos) << error;
  }
}

}  // namespace
}  // namespace ringlet::scene_camera_test
