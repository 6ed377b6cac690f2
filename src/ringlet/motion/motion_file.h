// A head's motion from a file, as the user names it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/motion/file_axis.h"
#include "ringlet/scene/motion.h"

namespace ringlet {

struct MotionFileChoice {
  std::filesystem::path path;
  std::string joint = "Head";             // glTF calls it a node
  std::optional<double> metresPerUnit{};  // unset: so that a BVH person is 1.7 m tall; glTF is in metres
  int skippedFrames = 0;                  // BVH: at the start, a T-pose
  std::string animation{};                // glTF: a name or a number from 0; empty: the first
  std::optional<FileAxis> up{};  // of the file; unset: as a BVH person stands (bvh_stance.h); glTF: Y
  std::string headJoint{};       // of the person whose unit and up axis the file has; empty: `joint`
};

enum class MotionFileKind { none, bvh, gltf };

/// ".bvh, .gltf, .glb or .vrm", the endings of files with motions.
inline constexpr const char* kMotionEndings = ".bvh, .gltf, .glb or .vrm";

/// What a name stands for, by its extension: .bvh, .gltf, .glb, .vrm, in any case; or no file with a motion.
MotionFileKind motionFileKind(const std::string& word);

/// Why a name that is of no kind of motion file has none: a file of another kind, or no file at all.
Error noMotionFile(const std::filesystem::path& path);

/// The joint's way, in a world whose up axis is Y, or Z. Warnings, of which none is said twice, say what was
/// taken for granted (a unit, an up axis, one animation of several, the number of frames), what no head does,
/// and that it does not move at all. Fails with the names of the joints where the joint is not there.
Result<Motion> readMotionFile(const MotionFileChoice& choice, bool upIsZ, std::vector<std::string>& warnings);

}  // namespace ringlet
