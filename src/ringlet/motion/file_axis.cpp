// Implements motion/file_axis.h.
#include "ringlet/motion/file_axis.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ringlet {
namespace {

constexpr double kNear = 0.8;         // cosine of the angle to an axis that a direction is taken for
constexpr double kUprightHead = 0.5;  // mean cosine of a head's angle to the up axis

// In the order of FileAxis.
constexpr std::array<std::string_view, 6> kNames{"X", "Y", "Z", "-X", "-Y", "-Z"};

// Where the axes go when the file's up becomes Y, in the order of FileAxis.
constexpr std::array<std::array<Vec3d, 3>, 6> kToY{{{{{0, 1, 0}, {-1, 0, 0}, {0, 0, 1}}},
                                                    {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
                                                    {{{1, 0, 0}, {0, 0, -1}, {0, 1, 0}}},
                                                    {{{0, -1, 0}, {1, 0, 0}, {0, 0, 1}}},
                                                    {{{1, 0, 0}, {0, -1, 0}, {0, 0, -1}}},
                                                    {{{1, 0, 0}, {0, 0, 1}, {0, -1, 0}}}}};

}  // namespace

std::string_view nameOf(FileAxis axis) { return kNames[static_cast<std::size_t>(axis)]; }

std::optional<FileAxis> fileAxisNamed(std::string_view name) {
  const auto found = std::ranges::find(kNames, name);
  if (found == kNames.end()) return std::nullopt;
  return static_cast<FileAxis>(found - kNames.begin());
}

Vec3d directionOf(FileAxis axis) {
  const auto number = static_cast<int>(axis);
  const double sign = number < 3 ? 1 : -1;
  return {number % 3 == 0 ? sign : 0, number % 3 == 1 ? sign : 0, number % 3 == 2 ? sign : 0};
}

std::optional<FileAxis> nearestFileAxis(Vec3d direction) {
  const double size = length(direction);
  if (!(size > 0) || !std::isfinite(size)) return std::nullopt;
  for (std::size_t k = 0; k < kNames.size(); ++k) {
    const auto axis = static_cast<FileAxis>(k);
    if (dot(direction, directionOf(axis)) >= kNear * size) return axis;
  }
  return std::nullopt;
}

Affine turnUp(FileAxis file, bool upIsZ) {
  const auto& toY = kToY[static_cast<std::size_t>(file)];
  const auto lifted = [&](Vec3d v) { return upIsZ ? Vec3d{v.x, -v.z, v.y} : v; };
  return {lifted(toY[0]), lifted(toY[1]), lifted(toY[2]), {}};
}

FileAxis jointUpOf(std::span<const HeadPose> poses, FileAxis file) {
  const Vec3d up = directionOf(file), usual = directionOf(FileAxis::plusY);
  double own = 0, other = 0;
  for (const HeadPose& pose : poses) {
    own += dot(rotate(pose.rotation, up), up);
    other += dot(rotate(pose.rotation, usual), up);
  }
  const double enough = kUprightHead * static_cast<double>(poses.size());
  return own < enough && other >= enough ? FileAxis::plusY : file;
}

Quatd turnedRotation(FileAxis file, FileAxis jointUp, bool upIsZ, Quatd rotation) {
  const auto asRotation = [](const Affine& turn) { return rotationOf(turn.x, turn.y, turn.z); };
  return normalized(asRotation(turnUp(file, upIsZ)) * rotation *
                    asRotation(turnUp(jointUp, upIsZ)).conjugate());
}

}  // namespace ringlet
