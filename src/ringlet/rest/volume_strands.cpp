// Implements rest/volume_strands.h.
#include "ringlet/rest/volume_strands.h"

#include <algorithm>

namespace ringlet {

VolumeStrands chooseVolumeStrands(const RestState& rest, const ContactParticles& particles,
                                  const DenseStrands& dense, const ContactSettings& settings) {
  const std::size_t strandCount = rest.strands.size();
  VolumeStrands volume;
  volume.cell = settings.volumeCell.value_or(volumeCellFor(rest, particles.baseRadius));
  if (settings.method == ContactMethod::volume) {
    volume.groups.resize(strandCount);
    volume.isIn.assign(strandCount, true);
  } else {
    static_cast<DenseStrands&>(volume) = settings.mayBeVolume() ? dense : noDenseStrands(rest);
  }
  volume.count = static_cast<std::size_t>(std::ranges::count(volume.isIn, true));
  return volume;
}

bool meetPairByPair(const VolumeStrands& volume, const ContactGraph& graph) {
  if (volume.count == 0) return true;
  if (graph.everyPair) {
    return std::ranges::any_of(volume.groups, [&](std::uint32_t group) { return group != volume.groups[0]; });
  }
  for (std::size_t s = 0; s + 1 < graph.firstNeighbour.size(); ++s) {
    for (std::uint32_t k = graph.firstNeighbour[s]; k < graph.firstNeighbour[s + 1]; ++k) {
      if (volume.groups[graph.neighbours[k]] != volume.groups[s]) return true;
    }
  }
  return false;
}

}  // namespace ringlet
