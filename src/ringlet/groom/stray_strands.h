// Strands that differ from all others as no hair of one groom does: in length, or in where they are.
#pragma once

#include <vector>

#include "ringlet/groom/groom.h"

namespace ringlet {

/// A strand is a stray if it is shorter or longer than the median by this factor, or if its distance from the
/// median place is this many times the median distance.
inline constexpr double kStrayLength = 20, kStrayDistance = 6;
/// Or if it is longer, by this factor, than nine of ten strands. Of grown hair the longest tenth is not three
/// times as long as all the rest.
inline constexpr double kStrayOfNine = 3;

struct StrayStrands {
  std::vector<bool> isTooShort{}, isTooLong{}, isFarAway{};  // of each strand
};

/// Strands without length are neither too short nor too long. Cost: linear in the particles, n log n in the
/// strands.
StrayStrands strayStrands(const Groom& groom);

}  // namespace ringlet
