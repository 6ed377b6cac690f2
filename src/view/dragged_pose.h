// DraggedPose: how far something is dragged away from where it would be. It follows the mouse smoothly, so
// that hair is not torn along by jerks.
#pragma once

#include <cmath>

#include "ringlet/base/vec3.h"

namespace ringlet::view {

struct Drag {
  Vec3d move{};  // [m]
  Quatd turn{};  // about its own origin, before it is moved
  bool operator==(const Drag&) const = default;
};

class DraggedPose {
 public:
  void move(Vec3d by) { target_.move += by; }
  void turn(Quatd by) { target_.turn = normalized(by * target_.turn); }
  void reset() { target_ = now_ = before_ = {}; }

  /// Goes on by so much time [s]; shares of the way are then those of this frame.
  void advance(double seconds) {
    const double share = 1 - std::exp(-seconds / kLag);
    before_ = now_;
    now_ = between(now_, target_, share);
  }
  /// At a share of the last frame, 1 at its end.
  Drag at(double share) const { return between(before_, now_, share); }
  const Drag& now() const { return now_; }
  const Drag& target() const { return target_; }

 private:
  static constexpr double kLag = 0.06;  // [s]: four fifths of a jerk in a tenth of a second

  static Drag between(const Drag& a, const Drag& b, double share) {
    return {a.move + (b.move - a.move) * share, slerp(a.turn, b.turn, share)};
  }

  Drag target_, now_, before_;
};

}  // namespace ringlet::view
