// FileAxis: the axis of a motion file that points up, and the turn from it to the groom's.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "ringlet/base/vec3.h"
#include "ringlet/motion/affine.h"
#include "ringlet/scene/head_pose.h"

namespace ringlet {

enum class FileAxis { plusX, plusY, plusZ, minusX, minusY, minusZ };

/// "Y, Z, X, -Y, -Z, -X", as files and options say them.
inline constexpr const char* kFileAxisNames = "Y, Z, X, -Y, -Z, -X";

std::string_view nameOf(FileAxis axis);
/// One of kFileAxisNames; nothing for another word.
std::optional<FileAxis> fileAxisNamed(std::string_view name);
/// Of length 1.
Vec3d directionOf(FileAxis axis);
/// The axis a direction is nearest to; nothing where it is not within 37 degrees of one, or has no length.
std::optional<FileAxis> nearestFileAxis(Vec3d direction);

/// The rotation that takes a file's up axis to Y, or to Z where the groom's up axis is that. X stays where
/// the file's up is not X.
Affine turnUp(FileAxis file, bool upIsZ);

/// Which axis of a head's joint is up on average, in poses of the file's world: the file's own; or Y, where
/// that one is not and Y is, as in files that were made Y up and turned as a whole. Of no poses the file's.
FileAxis jointUpOf(std::span<const HeadPose> poses, FileAxis file);

/// The rotation of a joint in the world that `turnUp(file, upIsZ)` makes: that of a groom which has its up
/// axis where the joint has `jointUp`.
Quatd turnedRotation(FileAxis file, FileAxis jointUp, bool upIsZ, Quatd rotation);

}  // namespace ringlet
