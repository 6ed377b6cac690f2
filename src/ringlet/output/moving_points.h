// MovingPoints: the points of the frame that is being written, as its file has them, and the velocities that
// follow from the frames about it.
#pragma once

#include <span>
#include <vector>

#include "ringlet/base/vec3.h"
#include "ringlet/groom/usd/usd_matrix.h"
#include "ringlet/output/animation_writer.h"

namespace ringlet {

/// Brings points of the world to where the head's motion is apart.
void seeFromHead(const UsdTransform& head, std::span<Vec3f> points);

/// A frame's velocities are half of what points move from the frame before to the frame after, times the
/// frames a second; so they are there once the next frame is, or the last has come. Memory: one frame, with
/// velocities three.
class MovingPoints {
 public:
  explicit MovingPoints(const AnimationOptions& options)
      : head_(options.usd.head), keepsFrames_(options.usd.velocities), rate_(options.framesPerSecond) {}

  /// Of the next frame: in the world, and where the head is.
  void take(std::span<const Vec3f> points, const UsdTransform& head);
  std::vector<Vec3f>& now() { return now_; }
  /// That frame is in the file: it is the last.
  void keep();
  /// Of a file that is resumed: the last frame, and the one before it if there is one.
  void resume(std::vector<Vec3f> beforeLast, std::vector<Vec3f> last);

  /// Of the last frame, which the present one follows [file unit/s].
  std::vector<Vec3f> velocitiesOfLast() const;
  /// Of the last frame, which none follows.
  std::vector<Vec3f> velocitiesAtEnd() const;

 private:
  std::vector<Vec3f> between(const std::vector<Vec3f>& before, const std::vector<Vec3f>& after,
                             double frames) const;

  UsdHead head_;
  bool keepsFrames_;
  double rate_;
  std::vector<Vec3f> now_, last_, beforeLast_;
};

}  // namespace ringlet
