// Hair that lies in itself at rest: pairs of strands nearer to each other than they are wide, and those of
// them that go through each other.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "ringlet/groom/groom.h"

namespace ringlet {

/// Two strands cross where they are nearer than this share of their width: hair of that width is all but
/// inside the other there, and which side it is on is chance.
inline constexpr double kCrossingShare = 0.1;

struct RestCrossings {
  double width = 0;                    // of a strand: the mean distance of a root to the nearest root, as
                                       // contacts take it by default [unit]
  std::uint64_t pairs = 0;             // of strands that cross
  std::uint64_t overlappingPairs = 0;  // of strands nearer than their width, those that cross among them
  std::size_t strands = 0;             // that cross another one
  std::size_t firstStrand = 0;         // the first of them; 0 without any
};

/// The places within two widths of a strand's root do not count: there hair is as dense as its roots. None
/// where roots have no distance, and where hair is so dense that an edge is near 2,000 others or 16 million
/// pairs of strands overlap: nearly all hair does. Cost: linear in the edges and in the overlaps of their
/// boxes, which are as wide as strands; 8 bytes a pair.
std::optional<RestCrossings> restCrossings(const Groom& groom);

}  // namespace ringlet
