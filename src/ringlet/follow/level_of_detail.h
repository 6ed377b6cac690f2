// Levels of detail: of a head that is far away only some strands are simulated, and the others follow them.
#pragma once

#include <cstdint>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/follow/follow_hairs.h"
#include "ringlet/groom/groom.h"

namespace ringlet {

struct LevelOfDetail {
  std::vector<std::uint32_t> guides;  // strands of the groom that are simulated, ascending; none: they are no
                                      // strands of it
  Groom groom;                        // those strands, in this order: what HairAsset::build is given
  std::vector<FollowHair> hairs;  // one a strand of the whole groom, in its order; FollowHair::guide is an
                                  // index into `guides`. The hair of a guide lies on the guide
  OwnPoints own;                  // of each: at rest all are where the groom has them
  std::vector<std::uint32_t> sample{};  // strands that follow and are simulated as well, to measure how well
                                        // they do: in `groom` after the guides

  /// Makes `count` of the strands of `whole` that follow the sample, or all of them, evenly from its order.
  void addSample(const Groom& whole, std::size_t count);
  /// Without the hairs of guides, where these are the last strands of the groom and no hairs of it.
  void leaveOutGuides();
};

/// Chooses `count` of the strands, or all (pickGuides). Every other strand follows the one of the four guides
/// most like it that fits it best: turned, scaled and shortened in the least squares of its outer three
/// fifths; the three nearest share its core, and what is left of its own shape goes along (OwnPoint). The
/// same groom gives the same choice. Errors: a strand without length. Cost: n log n in strands and n times
/// `count`, and the cores of all strands; on all processors.
Result<LevelOfDetail> levelOfDetailOfCount(const Groom& groom, std::size_t count);

/// The same of a share of the strands, in (0, 1], at least one. Errors: also a share outside its range.
Result<LevelOfDetail> levelOfDetail(const Groom& groom, double share);

/// The same with these guides: strands of the groom, rising, at least one.
Result<LevelOfDetail> levelOfDetailOfGuides(const Groom& groom, std::vector<std::uint32_t> guides);

}  // namespace ringlet
