// Camera: from where a picture is taken.
#pragma once

#include <span>
#include <vector>

#include "ringlet/base/vec3.h"

namespace ringlet {

struct Camera {
  Vec3d eye{0, 0, 1}, target{};  // [m]
  Vec3d up{0, 1, 0};             // roughly; not along the view
  double fieldOfView = 0.45;     // from top to bottom [rad], in (0, pi)
};

/// Where a camera stands about what it looks at.
struct CameraPlace {
  double azimuth = 0.6;     // about the up axis, from the front (+Z, or -Y where Z is up) to the right [rad]
  double elevation = 0.09;  // [rad], in (-pi/2, pi/2)
  double distance = 1;      // of what shows all that is looked at
};

/// The points, at least one, fill a picture whose width is `aspect` times its height, but for a margin.
/// `up`: unit vector, Y or Z.
Camera cameraAround(std::span<const Vec3d> points, Vec3d up, double aspect, const CameraPlace& place);

/// Of any number of points, those farthest along 26 ways: a camera that shows them shows nearly all.
class Outline {
 public:
  void add(Vec3d point);
  /// Of all that were added; none before the first.
  const std::vector<Vec3d>& points() const { return points_; }

 private:
  std::vector<Vec3d> points_;
  std::vector<double> reaches_;
};

/// The camera's axes in the world: to the right, up, and away from the eye; of length 1.
struct CameraAxes {
  Vec3d right, up, forward;
};
CameraAxes axesOf(const Camera& camera);

}  // namespace ringlet
