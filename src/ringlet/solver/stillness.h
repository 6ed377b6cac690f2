// Stillness: whether a head's next frame needs no steps, since its hair rests (Settings::sleepSpeed). The
// answer depends on frames that are two or more before it: so many may be in flight, and however many are, it
// is the same.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "layout/types.h"
#include "ringlet/base/archive.h"

namespace ringlet {

class Stillness {
 public:
  /// Frames in a row in which nothing acts on the hair anew and no particle moves, before it sleeps.
  static constexpr std::uint64_t kFrames = 8;

  /// Begins the next frame; `isQuiet`: all that acts on the hair in it did so in the frame before.
  void begin(bool isQuiet);
  /// Whether that frame needs no steps. From then on none does, until one is not quiet.
  bool sleeps() const { return sleeps_; }
  /// The hair is changed from outside: its next frame is not quiet.
  void wake() { quietSince_ = frame_ + 2; }
  /// The oldest frame that was begun is over: where its particles are, chunk by chunk, or nothing where that
  /// is not known. farthest: what a particle that does not move may have come in it [m].
  void observe(std::span<const std::span<const layout::vec4>> chunks, double farthest);

  void archive(Archive& archive);

 private:
  static constexpr std::uint64_t kLag = 2;

  std::uint64_t frame_ = 0;       // begun last, counted from 1
  std::uint64_t observed_ = 0;    // the last that is over
  std::uint64_t quietSince_ = 1;  // that frame and all since are
  // That frame and all since are still, as known when a frame was over, by its number.
  std::array<std::uint64_t, kLag + 1> stillSince_{1, 1, 1};
  bool sleeps_ = false;
  std::vector<layout::vec4> before_;  // positions when the last frame was over
};

}  // namespace ringlet
