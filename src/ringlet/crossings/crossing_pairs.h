// Which pairs of edges may pass through each other in a step. Of all others it is certain, whatever their
// particles do within `reach` of the ways the list was made for:
//
//     boxes     about what two edges sweep, widened by the reach, do not overlap; seen from the mean motion
//     a plane   across the direction between the nearest points parts both at the step's start, and at its
//     end
//               by twice the reach
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "ringlet/base/vec3.h"
#include "ringlet/crossings/crossing_judge.h"

namespace ringlet {

/// All that stays of hair: who is who. Strands one after another, in any order.
struct CrossingHair {
  std::vector<std::uint32_t> firstPoint;  // of each strand, and one more
  std::vector<std::uint32_t> bundles;     // of each strand, 0 none, which may cross those of it; empty: none
  std::vector<bool> takesPart;            // of each strand; empty: all do
  std::vector<double> masses;             // of each particle [kg]; 0: its way is given
  std::vector<double> lengths;            // of the edge that begins at each particle, in the groom [m]
  double maxStretch = 0;                  // the stretch limit; 0: none

  /// Of an edge, by its first particle: its way cannot be changed.
  bool isGiven(std::size_t edge) const { return masses[edge] == 0 && masses[edge + 1] == 0; }
  bool takes(std::size_t s) const { return takesPart.empty() || takesPart[s]; }
  bool mayMeet(std::uint32_t s, std::uint32_t t) const {
    return s != t && (bundles.empty() || bundles[s] == 0 || bundles[s] != bundles[t]);
  }
};

/// Where all particles are at the step's start and end [m].
struct CrossingWays {
  const std::vector<Vec3d>&from, &to;

  EdgeWay of(std::uint32_t edge) const { return {{from[edge], from[edge + 1]}, {to[edge], to[edge + 1]}}; }
};

/// Two edges, each by its first particle, p < q.
struct EdgePair {
  std::uint32_t p, q;
  PairDemand demand;

  std::array<std::uint32_t, 4> ends() const { return {p, p + 1, q, q + 1}; }
};

/// Ascending; without those whose ways are both given. gap, leastGap [m]: what PairDemand is made of
/// (demandOf). Cost: linear in edges and in overlaps of the boxes they sweep.
std::vector<EdgePair> listCrossingPairs(const CrossingHair& hair, const CrossingWays& ways, double reach,
                                        double gap, double leastGap);

}  // namespace ringlet
