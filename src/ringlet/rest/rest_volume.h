// RestVolume: the particles that meet others as a volume, with their masses and their densities at rest, for
// solver/contacts/volume_stage.h. Mirrored by reference/kernels/volume_step.h.
#pragma once

#include <cstdint>
#include <vector>

#include "ringlet/base/in_parallel.h"
#include "ringlet/rest/rest_contacts.h"
#include "ringlet/rest/rest_state.h"

namespace ringlet {

/// Arrays in device order, of particles of VolumeStrands. Of each strand one particle in a stride takes part
/// and represents that number of particles; the strand's place in the groom determines the first.
struct RestVolume {
  double cell = 0;                       // h [m]
  std::vector<std::uint32_t> particles;  // device index of each, ascending
  std::vector<std::uint32_t> strands;    // of each, device order
  std::vector<float> masses;             // of the particles that each represents [kg]
  std::vector<float> densities;          // of all hair at each one's place at rest [kg/m^3]
  std::vector<float> ownDensities;       // of its own strand alone [kg/m^3]
  float largestMass = 0;                 // of these masses [kg]
  double longestStrand = 0;              // its arc length [m]
  std::uint64_t cells = 0;               // that hair can reach, with strands 1.1 times as long
};

/// Densities are trilinear, on a grid of cell size h. `rest` must still have its particles. The same with any
/// number of threads. Cost: linear in particles.
RestVolume buildRestVolume(const RestState& rest, const RestContacts& contacts,
                           unsigned threadCount = coreCount());

}  // namespace ringlet
