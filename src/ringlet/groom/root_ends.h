// Which of its two ends a strand grows from, told by the head: a ball on which most strands have an end.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "ringlet/groom/ball.h"
#include "ringlet/groom/groom.h"

namespace ringlet {

/// How far each end of a strand is from what roots stand on, in any unit.
struct EndDistances {
  double first = 0, last = 0;
};

/// Strands that have their last end on what roots stand on and their first clearly off it: within `on` of it,
/// and further by `clear`. None where fewer than four of five strands have an end on it: roots are elsewhere.
std::vector<bool> reversedBy(std::span<const EndDistances> strands, double on, double clear);

/// Of each strand the first and the last particle that is no stray (stray_points.h).
struct StrandEnds {
  std::vector<Vec3d> first{}, last{};  // [unit]
};
StrandEnds strandEnds(const Groom& groom);

/// Of each strand the first particle [m].
std::vector<Vec3d> rootPlaces(const Groom& groom);

struct RootEnds {
  std::optional<Ball> head{};      // [unit]
  std::vector<bool> isReversed{};  // of each strand; where there is no head, none is
};

/// Of a groom as readers return it. There is a head where eight strands and more have their first ends, or
/// their last, or very evenly either, on one ball that hair is around rather than in; of twenty and more
/// three of ten may have none there. Of several such balls it is the smallest. Cost: n log n in the
/// particles.
RootEnds findRootEnds(const Groom& groom);

/// Turns these strands round: their last particle is the first. As many as the groom has.
void turnRound(const std::vector<bool>& which, Groom& groom);

}  // namespace ringlet
