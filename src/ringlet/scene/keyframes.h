// Keyframes: a head's motion as poses at times, interpolated between them.
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "ringlet/scene/head_pose.h"

namespace ringlet {

/// At least one pose. Their `shift` is not used.
struct Keyframes {
  /// Interpolation between keys.
  enum class Interpolation {
    cubic,   // a cubic through the keys, whose velocity is continuous
    linear,  // straight lines, and slerp
  };

  double secondsPerKey = 1.0 / 24;  // above 0; of equal times, from 0 on
  std::vector<HeadPose> poses;
  std::vector<double> times{};  // of each pose [s], rising; or none: they are equal
  Interpolation interpolation = Interpolation::cubic;
  bool restsAtEnds = false;  // the head rests before the first key and after the last and, with cubics, eases
                             // out of the one and into the other; false: any velocity at both ends

  /// Between keys that need a higher speed than this the head jumps [m/s]: it keeps its motion up to the
  /// second key and is there from then on.
  double cutSpeed = std::numeric_limits<double>::infinity();

  /// Whether the head jumps from key k to the next.
  bool isCut(std::size_t k) const {
    return length(poses[k + 1].position - poses[k].position) > cutSpeed * (timeOf(k + 1) - timeOf(k));
  }
  /// Time of pose k [s].
  double timeOf(std::size_t k) const {
    return times.empty() ? secondsPerKey * static_cast<double>(k) : times[k];
  }
  /// Time of the last pose [s].
  double seconds() const { return timeOf(poses.size() - 1); }
  /// Cubic, between equal times: positions on the cubic through four keys (Catmull and Rom 1974); rotations
  /// by slerp between two. Between times of their own: both on cubics whose velocity at a key is that of the
  /// parabola through it and its neighbours, rotations as the quaternions' four numbers, which suits keys up
  /// to half a turn apart. Before the first key, unless it rests there, the head glides into it at the
  /// velocity it goes on with, and begins to turn a third of a second before; after the last it stays. Cost:
  /// constant for equal times, else the logarithm of the number of keys.
  HeadPose poseAt(double t) const;
  /// The fastest turn between two neighbouring keys [rad/s], and which is the first of the two.
  struct Turn {
    double speed = 0;
    std::size_t key = 0;
  };
  Turn fastestTurn() const;
};

}  // namespace ringlet
