// PictureCamera: from where an animation's pictures are taken: a camera that shows all its frames, or one of
// the scene's.
#pragma once

#include <optional>
#include <span>

#include "ringlet/base/bounds.h"
#include "ringlet/base/vec3.h"
#include "ringlet/render/camera.h"
#include "ringlet/scene/motion.h"
#include "ringlet/scenes/load/scene_camera.h"

namespace ringlet {

/// About points in units of `metresPerUnit`, at least one, and so much beyond [m].
Bounds boundsOf(std::span<const Vec3f> points, double metresPerUnit, double margin);

struct PictureCameraChoice {
  CameraPlace place;                    // about the hair
  double orbit = 0;                     // that it goes round from the first frame to the last [rad]
  std::optional<LoadedCamera> ofScene;  // in place of both
};

class PictureCamera {
 public:
  /// `up`: of the world, Y or Z; `aspect`: of a picture, its width over its height. Of a scene's camera:
  /// where its head is.
  PictureCamera(const PictureCameraChoice& choice, Vec3d up, double aspect, const Motion* head,
                double framesPerSecond)
      : choice_(choice), up_(up), aspect_(aspect), head_(head), framesPerSecond_(framesPerSecond) {}

  /// Every frame from the first to the last: its points [m], and the box about them.
  void see(std::span<const Vec3f> points, double metresPerUnit, const Bounds& box);

  /// At a frame, from 1, or a share of one before; `turned`: the share of the orbit that is behind it;
  /// `here`: the box about the hair then. After all frames were seen.
  Camera at(double frame, double turned, const Bounds& here) const;

  const Bounds& all() const { return *all_; }        // about every frame
  double largestRadius() const { return largest_; }  // of a frame's box [m]

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
