// Implements motion/motion_file.h.
#include "ringlet/motion/motion_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <memory>
#include <numbers>
#include <utility>

#include "ringlet/motion/bvh_file.h"
#include "ringlet/motion/gltf_file.h"
#include "ringlet/motion/joint_name.h"

namespace ringlet {
namespace {

constexpr double kTall = 1.7;        // of a skeleton in no known unit [m]
constexpr double kFastestHead = 30;  // beyond it a turn is a jump [rad/s]

// From Y up to Z up: X stays.
HeadPose uprightAlongZ(const HeadPose& pose) {
  const Quatd lift = fromRotationVector(Vec3d{std::numbers::pi / 2, 0, 0});
  return {rotate(lift, pose.position), lift * pose.rotation * lift.conjugate()};
}

Result<Keyframes> readBvhMotion(const MotionFileChoice& choice, bool upIsZ,
                                std::vector<std::string>& warnings) {
  auto file = readBvh(choice.path);
  if (!file) return file.error();
  const auto joint = file->find(choice.joint);
  if (!joint) return noSuchJoint(choice.path.string(), "joint", choice.joint, file->names());
  const auto skipped = static_cast<std::size_t>(choice.skippedFrames);
  if (skipped + 2 > file->frameCount()) {
    return Error{fmt::format("{} has {} frames; without the first {} too few are left to move along",
                             choice.path.string(), file->frameCount(), skipped)};
  }
  const auto warn = [&](std::string sentence) {
    if (std::ranges::find(warnings, sentence) == warnings.end()) warnings.push_back(std::move(sentence));
  };
  const double height = file->height();
  const double unit = choice.metresPerUnit.value_or(height > 0 ? kTall / height : 0.01);
  if (!choice.metresPerUnit) {
    warn(fmt::format(
        "{} names no unit; its skeleton of {:.4g} units is taken to be {} m tall, a unit {:.4g} m",
        choice.path.string(), height, kTall, unit));
  }

  Keyframes keys = file->motionOf(*joint, unit, skipped);
  if (const auto fastest = keys.fastestTurn(); fastest.speed > kFastestHead) {
    warn(
        fmt::format("{}: from frame {} to the next {} turns at {:.0f} rad/s; where the first frame is a pose "
                    "apart from the "
                    "motion, skip it",
                    choice.path.string(), fastest.key + skipped + 1, choice.joint, fastest.speed));
  }
  if (upIsZ) {
    for (HeadPose& pose : keys.poses) pose = uprightAlongZ(pose);
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
  auto keys = file->motionOf(*node, *animation,
                             {.metresPerUnit = choice.metresPerUnit.value_or(1), .upIsZ = upIsZ}, {});
  if (!keys) return Error{fmt::format("{}: {}", name, keys.error().message)};
  if (keys->poses.size() < 2)
    return Error{fmt::format("{}: its animation {} takes no time", name, (*animation)->name)};
  if (const auto fastest = keys->fastestTurn(); fastest.speed > kFastestHead) {
    warnings.push_back(fmt::format("{}: {:.3g} s after the first key {} turns at {:.0f} rad/s", name,
                                   static_cast<double>(fastest.key) * keys->secondsPerKey, choice.joint,
                                   fastest.speed));
  }
  return keys;
}

}  // namespace

MotionFileKind motionFileKind(const std::string& word) {
  std::string extension = std::filesystem::path(word).extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (extension == ".bvh") return MotionFileKind::bvh;
  return extension == ".gltf" || extension == ".glb" ? MotionFileKind::gltf : MotionFileKind::none;
}

Result<Motion> readMotionFile(const MotionFileChoice& choice, bool upIsZ,
                              std::vector<std::string>& warnings) {
  const bool isGltf = motionFileKind(choice.path.string()) == MotionFileKind::gltf;
  auto keys = isGltf ? readGltfKeys(choice, upIsZ, warnings) : readBvhMotion(choice, upIsZ, warnings);
  if (!keys) return keys.error();
  return Motion{.kind = MotionKind::keyframes,
                .keyframes = std::make_shared<const Keyframes>(std::move(*keys))};
}

}  // namespace ringlet
