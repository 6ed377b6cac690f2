// BvhFile: a skeleton and its motion from a BVH text file, as motion capture writes them, and the way of one
// of its joints through the world. The format has no standard; what files do that others do not is said at
// readBvh.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/base/vec3.h"
#include "ringlet/scene/keyframes.h"

namespace ringlet {

/// In the file's unit and axes, neither of which it names (bvh_stance.h); angles in degrees.
struct BvhJoint {
  enum class Channel { xPosition, yPosition, zPosition, xRotation, yRotation, zRotation };

  std::string name;
  std::size_t parent = 0;  // of the root: itself
  Vec3d offset;            // from the parent
  std::vector<Channel> channels;
  std::size_t firstChannel = 0;  // in a frame
};

struct BvhFile {
  std::vector<BvhJoint>
      joints;  // a parent before its children; the ends of limbs are joints without channels
  double frameSeconds = 0;
  std::size_t channelCount = 0;
  std::vector<double> values;        // frame after frame, as many as both counts below allow
  std::size_t statedFrameCount = 0;  // by its line "Frames:"
  std::size_t foundFrameCount = 0;   // by its numbers

  std::size_t frameCount() const { return channelCount > 0 ? values.size() / channelCount : 0; }
  /// Where a joint is among its parent's in a frame: in place of its offset, where it has positions.
  Vec3d placeIn(std::size_t frame, std::size_t joint) const;
  Quatd turnIn(std::size_t frame, std::size_t joint) const;
  /// Where all joints are in a frame. Cost: linear in joints.
  std::vector<Vec3d> placesAt(std::size_t frame) const;
  /// Of all joints; the ends of limbs have empty ones.
  std::vector<std::string> names() const;
  /// A joint by its name; else, whatever the case, by what stands after a colon ("mixamorig:Head").
  std::optional<std::size_t> find(std::string_view name) const;
  /// The joint's poses from a frame on, which must be there. Cost: linear in frames and the joint's depth.
  Keyframes motionOf(std::size_t joint, double metresPerUnit, std::size_t firstFrame) const;
};

/// Any order of channels, positions in any joint (they stand in place of its offset), "Frames:455" without a
/// space, tabs, CR LF; more or fewer whole frames than stated, of which those beyond the count are left out.
/// Errors name the line: what is not BVH, numbers that are none or not finite, a part of a frame at the end,
/// a frame time that is not above 0, no frames.
Result<BvhFile> readBvh(const std::filesystem::path& path);
Result<BvhFile> parseBvh(std::string_view text);

}  // namespace ringlet
