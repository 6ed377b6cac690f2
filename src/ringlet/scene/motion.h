// Motion: the pose of a head over time, built-in or by keyframes. Built-in motions start at rest and ease in,
// except `glide`, whose constant velocity the hair has from the start.
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "ringlet/base/vec3.h"
#include "ringlet/scene/head_pose.h"
#include "ringlet/scene/keyframes.h"

namespace ringlet {

enum class MotionKind {
  still,      // does not move
  shake,      // to and fro along `axis`
  nod,        // turns to and fro about `axis`
  spin,       // turns about `axis` at constant speed, reached after easeSeconds
  glide,      // moves along `axis` at constant speed, from the first instant
  walk,       // on the spot, `axis` up: bobs at every step, sways and turns from leg to leg, nods a little
  turn,       // turns about `axis` once, in easeSeconds, and stays there
  jump,       // crouches, leaps along `axis` and lands, again and again
  whip,       // turns about `axis` once, in easeSeconds, and back in as long
  keyframes,  // as `keyframes` say, with any velocity at its start and end
};

/// Motion of roots relative to the head, as a share of each root's shift (HeadPose::shift): smoothly to the
/// full shift and back, or a sine about their places.
struct RootMotion {
  double frequency = 0;     // of a sine from -1 to 1 [Hz]; 0: moves to 1 and stays
  double easeSeconds = 1;   // grows smoothly from 0 over this time, and shrinks so at the end
  double untilSeconds = 0;  // time at which roots are back in place; 0: they never move

  double shareAt(double t) const;
};

/// Position and orientation of the head as a smooth function of time.
struct Motion {
  MotionKind kind = MotionKind::still;
  Vec3d axis{1, 0, 0};        // unit vector: direction of travel, or axis of turning
  double amplitude = 0.1;     // shake, walk (of its bob), jump (its height) [m]; nod, turn, whip [rad]; spin
                              // [rad/s]; glide [m/s]
  double frequency = 2;       // shake, nod, jump [Hz]; walk: strides, of two steps each [Hz]
  double easeSeconds = 0.25;  // all but glide: amplitude or speed grows smoothly from 0 over this time
  double untilSeconds = std::numeric_limits<double>::infinity();  // shake, nod, walk, jump: end of the
                                                                  // motion, which eases out
  Vec3d start{};                                                  // position of the head at t = 0 [m]
  RootMotion roots{};                                             // of roots with a shift
  std::shared_ptr<const Keyframes> keyframes{};                   // where `kind` says so; `start` is added
  Quatd axes{};  // of the groom in the frame of the moving joint: turned by it first

  /// The pose at t seconds; defined for t < 0 too (the state the motion comes from).
  HeadPose poseAt(double t) const;
};

/// The built-in motion of a name with its default amplitude, for a head whose up axis is `up`; nullopt for an
/// unknown name.
std::optional<Motion> motionByName(std::string_view name, Vec3d up);

/// The name of a kind; motionByName does not accept "keyframes".
std::string motionName(MotionKind kind);

/// Whether the motion is periodic, with a frequency and an optional end.
bool isToAndFro(MotionKind kind);

/// The names motionByName knows, separated by commas, for messages and --help.
std::string motionNames();

}  // namespace ringlet
