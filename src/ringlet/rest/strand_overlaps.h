// Finds which strands overlap at rest, and counts overlaps of their spheres. Iben et al. 2012, section 4.
#pragma once

#include <cstdint>
#include <vector>

#include "ringlet/base/in_parallel.h"
#include "ringlet/rest/contact_particles.h"
#include "ringlet/rest/rest_state.h"

namespace ringlet {

/// Two strands (device order) and the number of pairs of their enlarged spheres that overlap at rest.
struct StrandOverlap {
  std::uint32_t a, b;  // a < b
  std::uint32_t
      count;  // n_ab, of contact particles i of a and j of b with |p_i - p_j| < enlargement (r_a + r_b)

  bool operator==(const StrandOverlap&) const = default;
};

/// All pairs of strands that overlap, sorted by a, then b. The result does not depend on threadCount. Cost:
/// linear in contact particles and their overlaps; memory is proportional to pairs of strands, several times
/// over if they touch in several places.
std::vector<StrandOverlap> countOverlaps(const RestState& rest, const ContactParticles& particles,
                                         double enlargement, unsigned threadCount = coreCount());

}  // namespace ringlet
