// Levels of detail: of a head that is far away only some strands are simulated, and the others follow them.
#pragma once

#include <cstdint>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/follow/follow_hairs.h"
#include "ringlet/groom/groom.h"

namespace ringlet {

struct LevelOfDetail {
  std::vector<std::uint32_t> guides;  // strands of the groom that are simulated, ascending
  Groom groom;                        // those strands, in this order: what HairAsset::build is given
  std::vector<FollowHair> hairs;  // one a strand of the whole groom, in its order; FollowHair::guide is an
                                  // index into `guides`. The hair of a guide lies on the guide
};

/// Chooses `share` of the strands, in (0, 1], at least one, with roots as evenly spread as those of the groom
/// allow (eliminateSamples). Every other strand follows the one of the four guides with the nearest roots
/// that looks most like it: turned, scaled and shortened as fits its rest shape best, in the least squares of
/// its outer three fifths. A hair has as many points as its guide. The same groom gives the same choice.
/// Errors: a share outside its range; a strand without length. Cost: n log n in strands, and the cores of all
/// strands.
Result<LevelOfDetail> levelOfDetail(const Groom& groom, double share);

}  // namespace ringlet
