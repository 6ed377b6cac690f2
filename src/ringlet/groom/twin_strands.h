// Strands that are nearly another one, particle by particle, from root to tip or from tip to root: a strand
// that was written twice, through text or another unit. Strands of the very same particles are duplicatesIn()
// of mend_groom.h.
#pragma once

#include <vector>

#include "ringlet/groom/groom.h"

namespace ringlet {

/// Twins are no further apart, at any particle, than this share of the longer one's length: 0.02 mm of 20 cm,
/// a quarter of a hair's width. Neighbours in the densest hair are several widths apart somewhere.
inline constexpr double kTwinShare = 1e-4;

/// For each strand whether one before it, which is no twin itself, is its twin. Strands for which `isLeftOut`
/// is true are none and have none. Cost: linear in the particles; where the means of very many strands are in
/// one place, at most 256 strands are compared with each on average, and twins beyond that are not found.
std::vector<bool> twinStrands(const Groom& groom, const std::vector<bool>& isLeftOut);

}  // namespace ringlet
