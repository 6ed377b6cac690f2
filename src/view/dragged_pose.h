// DraggedPose: how far something is dragged away from where it would be. It follows the mouse smoothly, so
// that hair is not torn along by jerks.
#pragma once

#include <cmath>

#include "ringlet/base/vec3.h"
#include "ringlet/scenes/frames/scene_frames.h"

namespace ringlet::view {

class DraggedPose {
 public:
  void move(Vec3d by) { target_.move += by; }
  void turn(Quatd by) { target_.turn = normalized(by * target_.turn); }
  void reset() { target_ = {}, way_ = {}; }

  /// Goes on by so much time [s]: a frame's.
  void advance(double seconds) {
    const double share = 1 - std::exp(-seconds / kLag);
    way_ = {way_.to, between(way_.to, target_, share)};
  }
  /// Through the last frame.
  const DragWay& way() const { return way_; }
  const Drag& now() const { return way_.to; }
  const Drag& target() const { return target_; }

 private:
  static constexpr double kLag = 0.06;  // [s]: four fifths of a jerk in a tenth of a second

  Drag target_;
  DragWay way_;
};

}  // namespace ringlet::view
