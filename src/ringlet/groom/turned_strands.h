// Strands that run from tip to root among others that do not: told by the head where there is one
// (root_ends.h), and by the strands beside them, which run the other way.
//
//    r  r  t  r     Of two strands beside each other either first ends are near each other and last ones, or
//    |  |  |  |     first ends are near last ones. Pairs that tell most clearly are joined first; of strands
//    t  t  r  t     that are joined the fewer are turned round.
#pragma once

#include <vector>

#include "ringlet/groom/groom.h"

namespace ringlet {

/// Ends around an end whose strands are asked.
inline constexpr std::size_t kEndsAround = 8;
/// A pair tells where its ends are nearer in one way than in the other by this factor.
inline constexpr double kTellingPair = 0.6;
/// Of strands that are joined no more than this share is turned: of half of them nobody knows which half.
inline constexpr double kMostTurned = 0.4;

/// For each strand whether it is turned round. `isLeftOut` are strands that neither are nor tell, such as
/// those far away. Where there is no head and fewer than 8 strands are joined, none is. Where all strands run
/// from tip to root only a head tells; one is believed where first ends are not on a plane, and unless most
/// strands are joined and run otherwise. Cost: n log n in the particles.
std::vector<bool> turnedStrands(const Groom& groom, const std::vector<bool>& isLeftOut);

}  // namespace ringlet
