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
  bool restsAtEnds = false;  // before the first key the head stays where it is, eases out of it and, where
                             // the way is cubic, into the last; false: it comes and goes as it will

  /// From key to key faster than this the head is not seen to move: it goes on as it came until the next key,
  /// and is there then [m/s].
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
