// NearGuides: the guides whose roots are nearest to a place.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "ringlet/base/vec3.h"
#include "ringlet/follow/guide_rest.h"

namespace ringlet {

class NearGuides {
 public:
  explicit NearGuides(std::span<const GuideRest> guides);

  struct Near {
    double distance = 0;  // [m]
    std::uint32_t guide = 0;
  };
  /// `count` of them, or all, nearest first; of equals the first. Cost: about the root of their number.
  std::vector<Near> at(Vec3d place, std::size_t count) const;

  struct Share {
    std::uint32_t guide = 0;
    double share = 0;
  };
  /// The three nearest, nearest first, and shares that add up to 1 and vary continuously with the place: each
  /// is 0 where the guide is as far away as the fourth (Franke and Nielson 1980).
  std::array<Share, 3> sharesAt(Vec3d place) const;

 private:
  std::vector<std::uint32_t> order_;  // by height
  std::vector<Vec3d> roots_;          // in that order [m]
};

}  // namespace ringlet
