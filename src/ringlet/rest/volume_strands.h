// VolumeStrands: which strands meet as a volume and not pair by pair, decided once in the rest pose. A strand
// among many others feels their mean; which of them it touches changes from step to step and matters little.
// In sparse hair every pair matters.
#pragma once

#include <cstddef>

#include "ringlet/rest/contact_graph.h"
#include "ringlet/rest/contact_particles.h"
#include "ringlet/rest/dense_strands.h"
#include "ringlet/rest/rest_state.h"
#include "ringlet/scene/contact_settings.h"

namespace ringlet {

/// Device order. Strands of one group do not meet pair by pair: those that hang together in the volume, and
/// those of a bundle, which is not in the volume. A group is named by its first strand.
struct VolumeStrands : DenseStrands {
  std::size_t count = 0;  // of those in the volume
  double cell = 0;        // of the volume's grid [m]
  bool hasBundles = false;

  /// Whether some strands do not meet pair by pair.
  bool hasGroups() const { return count > 0 || hasBundles; }
  /// Whether two different strands are of one bundle, and so pass through each other.
  bool inOneBundle(std::size_t a, std::size_t b) const { return groups[a] == groups[b] && !isIn[a]; }
};

/// In the volume are, with the method `volume`, all strands, in one group; with `auto`, those that are dense;
/// bundles are not.
VolumeStrands chooseVolumeStrands(const RestState& rest, const ContactParticles& particles,
                                  const DenseStrands& dense, const ContactSettings& settings);

/// Whether any two strands that may touch are not of one group; always where there is no volume.
bool meetPairByPair(const VolumeStrands& volume, const ContactGraph& graph);

}  // namespace ringlet
