// FollowNumbers: how far hairs that follow are from where they would be, were they simulated.
#pragma once

#include <cstddef>

namespace ringlet {

/// Distances as shares of a hair's length, over all frames.
struct FollowNumbers {
  std::size_t hairs = 0;  // that were measured
  double rms = 0;         // of all their points
  double worst = 0;       // of the hair whose points are farthest off, their root mean square in a frame
};

}  // namespace ringlet
