// RestVolume: the particles of hair that is a volume, with their masses and their densities at rest, for
// solver/contacts/volume_stage.h. Mirrored by reference/kernels/volume_step.h.
#pragma once

#include <cstdint>
#include <vector>

#include "ringlet/base/in_parallel.h"
#include "ringlet/rest/rest_contacts.h"
#include "ringlet/rest/rest_state.h"

namespace ringlet {

/// Arrays in device order, of the volume's particles. Each represents some consecutive particles of one of
/// VolumeStrands by their mean: a stride of them, but fewer at the strand's ends, where its index in the
/// groom determines how many.
struct RestVolume {
  double cell = 0;                     // h [m]
  std::vector<std::uint32_t> firsts;   // device index of the first that each represents, ascending
  std::vector<std::uint32_t> counts;   // and their number
  std::vector<std::uint32_t> strands;  // of each, device order
  std::vector<float> masses;           // their total mass [kg]
  std::vector<float> densities;        // of all hair at each particle's place at rest [kg/m^3]
  std::vector<float> ownDensities;     // of the particle's own strand alone [kg/m^3]
  float largestMass = 0;               // of these masses [kg]
  double longestStrand = 0;            // arc length [m]
  std::uint64_t cells = 0;             // number that hair can reach, with strands 1.1 times as long
};

/// Densities are trilinear, on a grid of cell size h. `rest` must still have its particles. The result does
/// not depend on threadCount. Cost: linear in particles.
RestVolume buildRestVolume(const RestState& rest, const RestContacts& contacts,
                           unsigned threadCount = coreCount());

}  // namespace ringlet
