// PictureCamera: the camera of an animation's pictures: one that shows all of its frames, or one of the
// scene's.
#pragma once

#include <optional>
#include <span>

#include "ringlet/base/bounds.h"
#include "ringlet/base/vec3.h"
#include "ringlet/render/camera.h"
#include "ringlet/scene/motion.h"
#include "ringlet/scenes/load/scene_camera.h"

namespace ringlet {

/// The box of at least one point, in units of `metresPerUnit`, enlarged by `margin` [m].
Bounds boundsOf(std::span<const Vec3f> points, double metresPerUnit, double margin);

struct PictureCameraChoice {
  CameraPlace place;                    // relative to the hair
  double orbit = 0;                     // angle that the camera moves around the hair from the first frame to
                                        // the last [rad]
  std::optional<LoadedCamera> ofScene;  // if set, it replaces both
};

class PictureCamera {
 public:
  /// `up`: of the world, Y or Z; `aspect`: width over height of a picture. `head`: motion of the head, for a
  /// scene's camera.
  PictureCamera(const PictureCameraChoice& choice, Vec3d up, double aspect, const Motion* head,
                double framesPerSecond)
      : choice_(choice), up_(up), aspect_(aspect), head_(head), framesPerSecond_(framesPerSecond) {}

  /// Call for every frame from the first to the last: its points, and their box [m].
  void see(std::span<const Vec3f> points, double metresPerUnit, const Bounds& box);

  /// The camera at a frame, which counts from 1 and may be fractional. `turned`: share of the orbit done;
  /// `here`: the hair's box at that time. Call after all frames were seen.
  Camera at(double frame, double turned, const Bounds& here) const;

  const Bounds& all() const { return *all_; }        // the box of all frames
  double largestRadius() const { return largest_; }  // of the box of one frame [m]

 private:
  PictureCameraChoice choice_;
  Vec3d up_;
  double aspect_;
  const Motion* head_;
  double framesPerSecond_;
  std::optional<Bounds> all_;
  Outline outline_;  // of all frames
  double largest_ = 0;
};

}  // namespace ringlet
