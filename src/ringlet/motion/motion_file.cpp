// Implements motion/motion_file.h.
#include "ringlet/motion/motion_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <system_error>
#include <utility>

#include "ringlet/base/file_ending.h"
#include "ringlet/motion/bvh_file.h"
#include "ringlet/motion/bvh_stance.h"
#include "ringlet/motion/gltf_file.h"
#include "ringlet/motion/joint_name.h"
#include "ringlet/motion/motion_doubts.h"

namespace ringlet {
namespace {

constexpr double kFastestHead = 30;  // beyond it a turn is a jump [rad/s]

void addOnce(std::string sentence, std::vector<std::string>& warnings) {
  if (std::ranges::find(warnings, sentence) == warnings.end()) warnings.push_back(std::move(sentence));
}

Result<Keyframes> readBvhMotion(const MotionFileChoice& choice, bool upIsZ,
                                std::vector<std::string>& warnings) {
  auto file = readBvh(choice.path);
  if (!file) return file.error();
  const std::string name = choice.path.string();
  const auto joint = file->find(choice.joint);
  if (!joint) return noSuchJoint(name, "joint", choice.joint, file->names());
  const auto skipped = static_cast<std::size_t>(choice.skippedFrames);
  if (skipped + 2 > file->frameCount()) {
    const std::size_t stated = file->statedFrameCount, found = file->foundFrameCount;
    return Error{fmt::format(
        "{} has {}{}{}; a motion needs two frames", name,
        file->frameCount() == 1 ? "one frame" : fmt::format("{} frames", file->frameCount()),
        stated == found ? "" : fmt::format(" (it states {} and holds {})", stated, found),
        skipped == 0 ? ""
                     : fmt::format(", and the first {} are skipped (--skip-frames, skip_frames of [motion])",
                                   skipped))};
  }
  const auto head = choice.headJoint.empty() ? joint : file->find(choice.headJoint);
  const BvhStance stance = stanceOf(*file, skipped, choice.up, head);
  for (std::string& doubt : doubtsOf(*file, stance, name, choice.metresPerUnit, upIsZ))
    addOnce(std::move(doubt), warnings);

  Keyframes keys = file->motionOf(*joint, choice.metresPerUnit.value_or(unitOf(stance)), skipped);
  if (const auto fastest = keys.fastestTurn(); fastest.speed > kFastestHead) {
    addOnce(
        fmt::format(
            "{}: from frame {} to the next {} turns at {:.0f} rad/s; where the first frame is a pose apart "
            "from the motion, skip it",
            name, fastest.key + skipped + 1, choice.joint, fastest.speed),
        warnings);
  }
  const FileAxis jointUp =
      jointUpOf(!head || head == joint ? keys.poses : file->motionOf(*head, 1, skipped).poses, stance.up);
  if (stance.up != (upIsZ ? FileAxis::plusZ : FileAxis::plusY) || jointUp != stance.up) {
    const Affine turn = turnUp(stance.up, upIsZ);
    for (HeadPose& pose : keys.poses)
      pose = {turn(pose.position), turnedRotation(stance.up, jointUp, upIsZ, pose.rotation), pose.shift};
  }
  return keys;
}

Result<Keyframes> readGltfKeys(const MotionFileChoice& choice, bool upIsZ,
                               std::vector<std::string>& warnings) {
  const std::string name = choice.path.string();
  const auto file = readGltf(choice.path);
  if (!file) return file.error();
  const auto node = file->find(choice.joint);
  if (!node) return noSuchJoint(name, "node", choice.joint, file->names());
  if (file->animations.empty()) return Error{fmt::format("{} has no animation, so nothing moves", name)};
  const auto animation = file->animationNamed(choice.animation);
  if (!animation) return Error{fmt::format("{}: {}", name, animation.error().message)};
  if (choice.animation.empty() && file->animations.size() > 1) {
    warnings.push_back(fmt::format("{} has {} animations; the first, {}, is taken; name another to have that",
                                   name, file->animations.size(), (*animation)->name));
  }
  if (!file->moves(*node, *animation)) {
    warnings.push_back(fmt::format("{}: nothing in its animation {} moves {}; it stands still", name,
                                   (*animation)->name, choice.joint));
  }
  GltfPlacement placement{.metresPerUnit = choice.metresPerUnit.value_or(1),
                          .upIsZ = upIsZ,
                          .up = choice.up.value_or(FileAxis::plusY)};
  if (placement.up != FileAxis::plusY) {
    const auto head = choice.headJoint.empty() ? node : file->find(choice.headJoint);
    const auto asItIs = file->motionOf(head.value_or(*node), *animation, {}, {});
    if (asItIs) placement.jointUp = jointUpOf(asItIs->poses, placement.up);
  }
  auto keys = file->motionOf(*node, *animation, placement, {});
  if (!keys) return Error{fmt::format("{}: {}", name, keys.error().message)};
  if (keys->poses.size() < 2)
    return Error{fmt::format("{}: its animation {} takes no time", name, (*animation)->name)};
  if (choice.headJoint.empty() || choice.headJoint == choice.joint) {
    for (std::string& doubt : doubtsOf(*file, *node, *animation, placement, choice.up.has_value(), name))
      addOnce(std::move(doubt), warnings);
  }
  if (const auto fastest = keys->fastestTurn(); fastest.speed > kFastestHead) {
    warnings.push_back(fmt::format("{}: {:.3g} s after the first key {} turns at {:.0f} rad/s", name,
                                   static_cast<double>(fastest.key) * keys->secondsPerKey, choice.joint,
                                   fastest.speed));
  }
  return keys;
}

}  // namespace

MotionFileKind motionFileKind(const std::string& word) {
  const std::string extension = endingOf(word);
  if (extension == ".bvh") return MotionFileKind::bvh;
  const bool isGltf = extension == ".gltf" || extension == ".glb" || extension == ".vrm";
  return isGltf ? MotionFileKind::gltf : MotionFileKind::none;
}

Error noMotionFile(const std::filesystem::path& path) {
  std::error_code code;  // a file that cannot be looked at is as good as none
  const auto status = std::filesystem::status(path, code);
  if (std::filesystem::is_directory(status)) {
    return Error{fmt::format("{} is a folder; expected a motion file, {}", path.string(), kMotionEndings),
                 Fault::input};
  }
  const std::string ending = path.extension().string();
  if (std::filesystem::exists(status)) {
    return Error{fmt::format("{}: no motion is read from a file {}; expected {}", path.string(),
                             ending.empty() ? "without an ending" : "that ends in " + ending, kMotionEndings),
                 Fault::input};
  }
  return Error{fmt::format("there is no file {}, and motion files end in {}", path.string(), kMotionEndings),
               Fault::input};
}

Result<Motion> readMotionFile(const MotionFileChoice& choice, bool upIsZ,
                              std::vector<std::string>& warnings) {
  const MotionFileKind kind = motionFileKind(choice.path.string());
  if (kind == MotionFileKind::none) return noMotionFile(choice.path);
  auto keys = kind == MotionFileKind::gltf ? readGltfKeys(choice, upIsZ, warnings)
                                           : readBvhMotion(choice, upIsZ, warnings);
  if (!keys) return keys.error();
  return Motion{.kind = MotionKind::keyframes,
                .keyframes = std::make_shared<const Keyframes>(std::move(*keys))};
}

}  // namespace ringlet
