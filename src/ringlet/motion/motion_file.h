// A head's motion from a file, as the user names it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/scene/motion.h"

namespace ringlet {

struct MotionFileChoice {
  std::filesystem::path path;
  std::string joint = "Head";           // glTF calls it a node
  std::optional<double> metresPerUnit;  // unset: so that a BVH skeleton is 1.7 m tall; glTF is in metres
  int skippedFrames = 0;                // BVH: at the start, a T-pose
  std::string animation;                // glTF: a name or a number from 0; empty: the first
};

enum class MotionFileKind { none, bvh, gltf };

/// What a name stands for, by its extension: .bvh, .gltf, .glb; or no file but a built-in motion.
MotionFileKind motionFileKind(const std::string& word);

/// The joint's way, in a world whose up axis is Y, or Z. Warnings, of which none is said twice, say what was
/// taken for granted (a unit, one animation of several), where the head turns faster than any, and that it
/// does not move at all. Fails with the names of the joints where the joint is not there.
Result<Motion> readMotionFile(const MotionFileChoice& choice, bool upIsZ, std::vector<std::string>& warnings);

}  // namespace ringlet
