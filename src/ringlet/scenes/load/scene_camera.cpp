// Implements scenes/load/scene_camera.h.
#include "ringlet/scenes/load/scene_camera.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <numbers>
#include <system_error>
#include <utility>

#include "ringlet/motion/gltf_file.h"
#include "ringlet/motion/joint_name.h"
#include "ringlet/motion/motion_file.h"
#include "ringlet/scenes/load/load_scene.h"
#include "ringlet/scenes/load/scene_parts.h"

namespace ringlet {
namespace {

std::vector<std::string> cameraNamesOf(const GltfFile& file) {
  std::vector<std::string> names;
  for (const GltfNode& node : file.nodes)
    if (node.camera) names.push_back(node.name);
  return names;
}

bool isGltf(const std::filesystem::path& path) {
  return motionFileKind(path.string()) == MotionFileKind::gltf;
}

// The file's world is the head's where the head's motion is of the same file.
Result<LoadedCamera> cameraOfGltf(const SceneFile& scene, const std::filesystem::path& path,
                                  const std::string& name) {
  const auto file = readGltf(path);
  if (!file) return file.error();
  std::vector<std::size_t> nodes;
  for (std::size_t n = 0; n < file->nodes.size(); ++n)
    if (file->nodes[n].camera) nodes.push_back(n);
  const std::vector<std::string> names = cameraNamesOf(*file);
  const auto which = findJoint(names, name);
  if (!which) return noSuchJoint(path.string(), "camera", name, names);
  const auto angle = file->cameras[*file->nodes[nodes[*which]].camera].heightAngle;
  if (!angle)
    return Error{fmt::format(
        "the camera {} of {} is orthographic, or its yfov is not between 0 and pi; pictures are perspective",
        name, path.string())};
  std::error_code code;  // files that are not there are no error of this
  const bool isHeads =
      !scene.motion.file.empty() && std::filesystem::equivalent(scene.motion.file, path, code);
  const auto animation = file->animationNamed(isHeads ? scene.motion.animation : "");
  if (!animation) return Error{fmt::format("{}: {}", path.string(), animation.error().message)};
  const bool upIsZ = scene.groom.up == "Z";
  auto keys = file->motionOf(
      nodes[*which], *animation,
      {.metresPerUnit = isHeads ? scene.motion.metresPerUnit.value_or(1) : 1,
       .upIsZ = upIsZ,
       .up = isHeads ? fileAxisNamed(scene.motion.up).value_or(FileAxis::plusY) : FileAxis::plusY,
       .jointUp = FileAxis::plusY},  // cameras look along -Z, whatever the file's up axis
      {});
  if (!keys) return Error{fmt::format("{}: {}", path.string(), keys.error().message)};
  LoadedCamera camera{.name = name,
                      .seen = {.eye = {},
                               .target = upIsZ ? Vec3d{0, 1, 0} : Vec3d{0, 0, -1},
                               .up = upOf(scene.groom),
                               .fieldOfView = *angle}};
  camera.motion = Motion{.kind = MotionKind::keyframes,
                         .start = isHeads ? scene.motion.start : Vec3d{},
                         .keyframes = std::make_shared<const Keyframes>(std::move(*keys))};
  return camera;
}

Result<LoadedCamera> cameraAtPlace(const SceneFile& scene, const SceneCamera& stated) {
  LoadedCamera camera{.name = stated.name,
                      .seen = {.eye = *stated.eye,
                               .target = stated.target,
                               .up = stated.up.value_or(upOf(scene.groom)),
                               .fieldOfView = stated.fieldOfView * std::numbers::pi / 180}};
  camera.isOnHead = stated.bind == "head";
  if (stated.joint.empty()) return camera;
  const SceneMotion& head = scene.motion;
  std::vector<std::string> warnings;  // said of the head already
  MotionFileChoice choice = motionFileOf(head);
  choice.joint = stated.joint;
  auto motion = readMotionFile(choice, scene.groom.up == "Z", warnings);
  if (!motion) {
    return Error{fmt::format("the camera {}: {}", stated.name, motion.error().message), motion.error().fault};
  }
  motion->start = head.start;
  camera.motion = std::move(*motion);
  return camera;
}

// For the message where there is no such camera.
std::vector<std::string> allNames(const SceneFile& scene) {
  std::vector<std::string> names;
  for (const SceneCamera& camera : scene.cameras) names.push_back(camera.name);
  if (!isGltf(scene.motion.file)) return names;
  const auto file = readGltf(scene.motion.file);
  if (!file) return names;
  for (std::string& name : cameraNamesOf(*file))
    if (!name.empty()) names.push_back(std::move(name));
  return names;
}

}  // namespace

CameraView LoadedCamera::viewAt(double t, const HeadPose& head) const {
  if (!motion && !isOnHead) return seen;
  const HeadPose pose = motion ? motion->poseAt(t) : head;
  return {pose.position + rotate(pose.rotation, seen.eye), pose.position + rotate(pose.rotation, seen.target),
          rotate(pose.rotation, seen.up), seen.fieldOfView};
}

Result<LoadedCamera> loadCamera(const SceneFile& scene, const std::string& name) {
  const auto stated = std::ranges::find(scene.cameras, name, &SceneCamera::name);
  if (stated != scene.cameras.end())
    return stated->eye ? cameraAtPlace(scene, *stated) : cameraOfGltf(scene, stated->file, name);
  const std::vector<std::string> names = allNames(scene);
  if (names.empty())
    return Error{fmt::format(
        "there is no camera {}: the scene has no [[camera]], and its motion is of no glTF file with one",
        name)};
  if (!findJoint(names, name)) return noSuchJoint("the scene", "camera", name, names);
  return cameraOfGltf(scene, scene.motion.file, name);
}

}  // namespace ringlet
