// A camera that a scene names, over time: one of its [[camera]], or of the glTF file that the head's motion
// is of.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/base/vec3.h"
#include "ringlet/scene/head_pose.h"
#include "ringlet/scene/motion.h"
#include "ringlet/scenes/file/scene_file.h"

namespace ringlet {

/// Of a camera at a time: in the world.
struct CameraView {
  Vec3d eye, target, up;   // [m]
  double fieldOfView = 0;  // from top to bottom [rad]
};

/// `seen` is in a frame that something carries, or in the world.
struct LoadedCamera {
  std::string name;
  CameraView seen;
  std::optional<Motion> motion{};  // that carries it
  bool isOnHead = false;           // the head carries it

  /// t seconds after the start, with the head at `head`.
  CameraView viewAt(double t, const HeadPose& head) const;
};

/// Reads the files that it is of. Errors: there is none of that name; the message lists those there are. It
/// is not perspective, or its file or joint cannot be read.
Result<LoadedCamera> loadCamera(const SceneFile& scene, const std::string& name);

}  // namespace ringlet
