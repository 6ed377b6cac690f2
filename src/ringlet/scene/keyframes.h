// Keyframes: a head's motion as poses at equal times, with a smooth way between them.
#pragma once

#include <vector>

#include "ringlet/scene/head_pose.h"

namespace ringlet {

/// At least one pose. Their `shift` is not used.
struct Keyframes {
  double secondsPerKey = 1.0 / 24;  // above 0
  std::vector<HeadPose> poses;

  /// From the first pose to the last.
  double seconds() const { return secondsPerKey * static_cast<double>(poses.size() - 1); }
  /// Positions on the cubic through four keys (Catmull and Rom 1974), whose velocity is continuous; rotations
  /// by slerp between two. Before the first key the head glides into it at the velocity it goes on with, and
  /// begins to turn a third of a second before; after the last it stays. Cost: constant.
  HeadPose poseAt(double t) const;
  /// The fastest turn between two neighbouring keys [rad/s], and which is the first of the two.
  struct Turn {
    double speed = 0;
    std::size_t key = 0;
  };
  Turn fastestTurn() const;
};

}  // namespace ringlet
