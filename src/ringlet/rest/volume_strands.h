// VolumeStrands: which strands meet as a volume and not pair by pair, decided once in the rest pose. A strand
// among many others feels their mean; which of them it touches changes from step to step and matters little.
// In sparse hair every pair matters.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "ringlet/rest/contact_graph.h"
#include "ringlet/rest/contact_particles.h"
#include "ringlet/rest/rest_state.h"
#include "ringlet/scene/contact_settings.h"

namespace ringlet {

/// Device order.
struct VolumeStrands {
  /// Strands of one group do not meet pair by pair. Of strands in the volume: the first of all that hang
  /// together by cells that both are in; of others: the strand itself.
  std::vector<std::uint32_t> groups;
  std::vector<bool> isIn;  // of each strand: it is part of the volume
  std::size_t count = 0;   // of those that are
  double cell = 0;         // of the volume's grid [m]
};

/// With the method `volume`: all, in one group. With `auto`, by density: that of a strand is the harmonic
/// mean over its particles of what is about them over what its own strand is, in cells as they are without a
/// setting. Strands of half of kVolumeStrands and more that share cells hang together; if the median of those
/// has kVolumeStrands, they are a group of the volume. Cost: linear in particles.
VolumeStrands chooseVolumeStrands(const RestState& rest, const ContactParticles& particles,
                                  const ContactSettings& settings);

/// Whether any two strands that may touch are not of one group; always where there is no volume.
bool meetPairByPair(const VolumeStrands& volume, const ContactGraph& graph);

}  // namespace ringlet
