// VolumeStrands: the strands that are in contact as a volume and not pair by pair, chosen once in the rest
// pose. A strand among many others feels their mean; its individual partners change from step to step and
// matter little. In sparse hair every pair matters.
#pragma once

#include <cstddef>

#include "ringlet/rest/contact_graph.h"
#include "ringlet/rest/contact_particles.h"
#include "ringlet/rest/dense_strands.h"
#include "ringlet/rest/rest_state.h"
#include "ringlet/scene/contact_settings.h"

namespace ringlet {

/// Device order. Strands of one group do not touch pair by pair. A group is either a connected part of the
/// volume, or a bundle, which is not in the volume. The index of its first strand identifies it.
struct VolumeStrands : DenseStrands {
  std::size_t count = 0;  // strands in the volume
  double cell = 0;        // of the volume's grid [m]
  bool hasBundles = false;

  /// Whether there are groups.
  bool hasGroups() const { return count > 0 || hasBundles; }
  /// Whether two different strands are in one bundle; they then pass through each other.
  bool inOneBundle(std::size_t a, std::size_t b) const { return groups[a] == groups[b] && !isIn[a]; }
};

/// With the method `volume` all strands are in the volume, in one group; with `auto` the dense ones. Bundles
/// never are.
VolumeStrands chooseVolumeStrands(const RestState& rest, const ContactParticles& particles,
                                  const DenseStrands& dense, const ContactSettings& settings);

/// Whether any two strands that may touch are in different groups; true if there is no volume.
bool meetPairByPair(const VolumeStrands& volume, const ContactGraph& graph);

}  // namespace ringlet
