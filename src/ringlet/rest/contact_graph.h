// ContactGraph: which strands may touch, decided once in the rest pose. Iben et al. 2012, section 4: a node
// per strand; radii are enlarged, overlaps of spheres counted, weak edges of the graph dropped, then some at
// random, because their neighbours carry the interaction. Interactions are pruned, never hairs.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "ringlet/rest/contact_particles.h"
#include "ringlet/rest/rest_state.h"
#include "ringlet/scene/contact_settings.h"

namespace ringlet {

/// Two strands (device order) and how many pairs of their enlarged spheres overlap at rest.
struct StrandOverlap {
  std::uint32_t a, b;  // a < b
  std::uint32_t
      count;  // n_ab, of contact particles i of a and j of b with |p_i - p_j| < enlargement (r_a + r_b)

  bool operator==(const StrandOverlap&) const = default;
};

struct ContactGraph {
  bool everyPair = false;  // no pruning: any two strands may touch, and the two arrays are empty
  std::vector<std::uint32_t> firstNeighbour;  // strandCount + 1 entries, into:
  std::vector<std::uint32_t> neighbours;  // of each strand, device order, ascending; both ends know the other
  std::uint64_t pairsUnpruned = 0;        // of strands that overlap at rest, enlarged
  std::uint64_t pairs = 0;                // of those, that may touch
  std::uint64_t overlapsUnpruned = 0;     // pairs of spheres in pairsUnpruned
  std::uint64_t overlaps = 0;             // and in pairs
  std::vector<std::string> warnings;      // for the user: that nothing can touch

  /// Whether two different strands (device order) may touch.
  bool allows(std::uint32_t a, std::uint32_t b) const;
};

/// All pairs of strands that overlap, by a, then b. Cost: linear in contact particles and their overlaps;
/// memory by pairs of strands only.
std::vector<StrandOverlap> countOverlaps(const RestState& rest, const ContactParticles& particles,
                                         double enlargement);

/// Keeps pairs of at least minOverlaps; of these, those that are among the maxNeighbours strongest of both
/// strands (by count, then by the other's place in the groom); of these, all but dropShare, by the seed and
/// both places in the groom. So the order of strands in memory changes nothing.
ContactGraph pruneStrandPairs(std::span<const StrandOverlap> overlaps, const RestState& rest,
                              const ContactSettings& settings);

}  // namespace ringlet
