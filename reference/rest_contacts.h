// Which particles and which strands may touch, from the rest pose: the reference's own, by plain loops over
// all pairs; a test compares it with ringlet/rest. Iben et al. 2012, section 4; spacing, radii and the
// deterministic choice of pairs are ours.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "reference/fields.h"
#include "reference/rest_strand.h"
#include "ringlet/scene/contact_settings.h"

namespace ringlet::reference {

/// One entry a strand, groom order.
struct RestContacts {
  std::vector<double> radii{};                           // of all its particles [m]
  std::vector<double> masses{};                          // m_c: its mass over its contact particles [kg]
  std::vector<std::vector<std::uint32_t>> particles{};   // that take part in contacts, ascending, 0 the root
  bool prunesPairs = true;                               // false: every pair of strands may touch
  std::vector<std::vector<std::uint32_t>> neighbours{};  // strands it may touch, ascending; if prunesPairs

  double volumeCell = 0;  // of the volume's grid [m]
  // Of each strand: the first of those in the volume it hangs together with, or kNoGroup
  // (rest/volume_strands.h).
  static constexpr std::uint32_t kNoGroup = 0xffffffffu;
  std::vector<std::uint32_t> volumeGroups{};

  std::vector<std::uint32_t> bundles{};  // of each strand, or kNoGroup; none of these is in the volume

  bool isInVolume(std::size_t s) const { return !volumeGroups.empty() && volumeGroups[s] != kNoGroup; }
  bool mayTouch(std::uint32_t s, std::uint32_t t) const {
    if (isInVolume(s) && isInVolume(t) && volumeGroups[s] == volumeGroups[t]) return false;
    if (!bundles.empty() && bundles[s] != kNoGroup && bundles[s] == bundles[t]) return false;
    if (!prunesPairs) return s != t;
    return std::binary_search(neighbours[s].begin(), neighbours[s].end(), t);
  }
};

/// n_ab of all pairs of strands, [s][t]: how many of their spheres, enlarged, overlap at rest.
std::vector<std::vector<int>> overlapCounts(const std::vector<Field<double>>& strands,
                                            const RestContacts& rest, double enlargement);

/// Pair pruning: pairs of strands with minOverlaps, among the maxNeighbours strongest of both, and not
/// dropped at random.
std::vector<std::vector<std::uint32_t>> prunedNeighbours(const std::vector<std::vector<int>>& counts,
                                                         const ContactSettings& settings);

/// All of the above, for strands in groom order.
template <class Real>
RestContacts makeRestContacts(const std::vector<RestStrand<Real>>& strands, const ContactSettings& settings);

}  // namespace ringlet::reference
