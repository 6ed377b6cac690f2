// Stillness: decides whether a head's next frame needs no steps, since its hair is at rest
// (Settings::sleepSpeed). The decision uses only frames that are two or more before it, so that it does not
// depend on the number of frames in flight.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "ringlet/base/archive.h"
#include "ringlet/base/vec3.h"

namespace ringlet {

class Stillness {
 public:
  /// Hair sleeps after this number of consecutive frames in which no input changes and no particle moves.
  static constexpr std::uint64_t kFrames = 8;

  /// Begins the next frame; `isQuiet`: its inputs are the same as in the last frame.
  void begin(bool isQuiet);
  /// Whether that frame needs no steps. It stays true until a frame is not quiet.
  bool sleeps() const { return sleeps_; }
  /// Notes a change from outside: the next frame is not quiet.
  void wake() { quietSince_ = frame_ + 2; }
  /// Reports the positions at the end of the oldest frame that was begun and not reported; empty: they are
  /// unknown. farthest: a particle that moved by less counts as not moving [m].
  void observe(std::span<const Vec3f> now, double farthest);

  void archive(Archive& archive);

 private:
  static constexpr std::uint64_t kLag = 2;

  std::uint64_t frame_ = 0;       // the last that was begun, counted from 1
  std::uint64_t observed_ = 0;    // the last that has ended
  std::uint64_t quietSince_ = 1;  // this frame and all since are quiet
  // All frames since this one are still, as known at the end of a frame; indexed by that frame's number.
  std::array<std::uint64_t, kLag + 1> stillSince_{1, 1, 1};
  bool sleeps_ = false;
  std::vector<Vec3f> before_;  // positions at the end of the last frame
};

}  // namespace ringlet
