// Implements program/motion_file.h.
#include "program/motion_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <memory>
#include <numbers>
#include <utility>

#include "ringlet/base/nearest_name.h"
#include "ringlet/motion/bvh_file.h"

namespace ringlet::program {
namespace {

constexpr double kTall = 1.7;            // of a skeleton in no known unit [m]
constexpr double kFastestHead = 30;      // beyond it a turn is a jump [rad/s]
constexpr std::size_t kNamesShown = 12;  // in a message

Error noSuchJoint(const MotionFileChoice& choice, const BvhFile& file) {
  std::vector<std::string> names;
  for (const BvhJoint& joint : file.joints) {
    if (!joint.name.empty()) names.push_back(joint.name);
  }
  const std::size_t near = nearestName(choice.joint, names);
  if (near < names.size())
    return Error{
        fmt::format("{} has no joint {}; did you mean {}?", choice.path.string(), choice.joint, names[near])};
  std::string shown;
  for (std::size_t k = 0; k < std::min(names.size(), kNamesShown); ++k)
    shown += fmt::format("{}{}", k > 0 ? ", " : "", names[k]);
  return Error{
      fmt::format("{} has no joint {}; it has {}{}", choice.path.string(), choice.joint, shown,
                  names.size() > kNamesShown ? fmt::format(" and {} more", names.size() - kNamesShown) : "")};
}

// From Y up to Z up: X stays.
HeadPose uprightAlongZ(const HeadPose& pose) {
  const Quatd lift = fromRotationVector(Vec3d{std::numbers::pi / 2, 0, 0});
  return {rotate(lift, pose.position), lift * pose.rotation * lift.conjugate()};
}

}  // namespace

bool isMotionFile(const std::string& word) {
  std::string extension = std::filesystem::path(word).extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension == ".bvh";
}

Result<Motion> readMotionFile(const MotionFileChoice& choice, UpAxis up, std::vector<std::string>& warnings) {
  auto file = readBvh(choice.path);
  if (!file) return file.error();
  const auto joint = file->find(choice.joint);
  if (!joint) return noSuchJoint(choice, *file);
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
        "{} names no unit; its skeleton of {:.4g} units is taken to be {} m tall, --motion-unit {:.4g}",
        choice.path.string(), height, kTall, unit));
  }

  Keyframes keys = file->motionOf(*joint, unit, skipped);
  if (const auto fastest = keys.fastestTurn(); fastest.speed > kFastestHead) {
    warn(
        fmt::format("{}: from frame {} to the next {} turns at {:.0f} rad/s; where the first frame is a pose "
                    "apart from the "
                    "motion, leave it out with --skip-frames 1",
                    choice.path.string(), fastest.key + skipped + 1, choice.joint, fastest.speed));
  }
  if (up == UpAxis::z) {
    for (HeadPose& pose : keys.poses) pose = uprightAlongZ(pose);
  }
  return Motion{.kind = MotionKind::keyframes,
                .keyframes = std::make_shared<const Keyframes>(std::move(keys))};
}

}  // namespace ringlet::program
