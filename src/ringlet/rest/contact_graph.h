// ContactGraph: the pairs of strands that may touch, chosen once in the rest pose. Iben et al. 2012, section
// 4: a graph with a strand per node. Overlaps of spheres of enlarged radii are counted; pairs with few
// overlaps are dropped, then some pairs at random, because their neighbours carry the interaction. Strands
// are never dropped.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "ringlet/rest/rest_state.h"
#include "ringlet/rest/strand_overlaps.h"
#include "ringlet/scene/contact_settings.h"

namespace ringlet {

struct ContactGraph {
  bool everyPair = false;  // no pruning: any two strands may touch, and these arrays are empty
  std::vector<std::uint32_t> firstNeighbour;  // strandCount + 1 entries, into:
  std::vector<std::uint32_t> neighbours;      // of each strand, device order, ascending
  std::vector<std::uint32_t> counts;          // overlaps at rest with each neighbour
  std::uint64_t pairsUnpruned = 0;            // pairs of strands that overlap at rest with enlarged radii
  std::uint64_t pairs = 0;                    // of these, pairs that may touch
  std::uint64_t overlapsUnpruned = 0;         // pairs of spheres in these pairs of strands
  std::uint64_t overlaps = 0;                 // of these, in `pairs`
  std::vector<std::string> warnings;          // for the user: that no strands may touch

  /// Whether two different strands (device order) may touch.
  bool allows(std::uint32_t a, std::uint32_t b) const;
};

/// Keeps pairs with minOverlaps or more. Of these it keeps pairs that are among the maxNeighbours strongest
/// of both strands (by count, then by the other's index in the groom); and of these it drops a random share,
/// dropShare, chosen by the seed and both indices in the groom. The result does not depend on the order of
/// strands in memory.
ContactGraph pruneStrandPairs(std::span<const StrandOverlap> overlaps, const RestState& rest,
                              const ContactSettings& settings);

}  // namespace ringlet
