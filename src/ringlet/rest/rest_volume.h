// RestVolume: the particles that meet others as a volume, with what the rest pose says of each; what
// solver/volume_stage.h starts from. Mirrored by reference/kernels/volume_step.h.
#pragma once

#include <cstdint>
#include <vector>

#include "ringlet/rest/rest_contacts.h"
#include "ringlet/rest/rest_state.h"

namespace ringlet {

/// Arrays in device order, of particles of VolumeStrands: of each strand one in so many, for as many, which
/// one to begin with by its place in the groom.
struct RestVolume {
  double cell = 0;                       // h [m]
  std::vector<std::uint32_t> particles;  // device index of each, ascending
  std::vector<std::uint32_t> strands;    // of each, device order
  std::vector<float> masses;             // of those each stands for [kg]
  std::vector<float> densities;          // of all of them, at its place at rest [kg/m^3]
  std::vector<float> ownDensities;       // of its own strand's [kg/m^3]
  std::uint64_t cells = 0;               // that hair may reach, the head still and strands 1.1 times as long
};

/// Densities are those of a grid of cells of h, trilinear. `rest` still has its particles. Cost: linear in
/// particles.
RestVolume buildRestVolume(const RestState& rest, const RestContacts& contacts);

}  // namespace ringlet
