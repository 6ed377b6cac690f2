// Implements rest/volume_strands.h.
#include "ringlet/rest/volume_strands.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <unordered_map>
#include <utility>

namespace ringlet {
namespace {

// Takes bundles out of the volume, each a group of its own.
void takeOut(const std::vector<ContactBundle>& bundles, const RestState& rest, VolumeStrands& volume) {
  std::unordered_map<std::uint32_t, std::uint32_t> bundleOf;  // of strands in groom order, from 1
  for (std::uint32_t b = 0; b < bundles.size(); ++b)
    for (const std::uint32_t strand : bundles[b]) bundleOf[strand] = b + 1;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t>
      firstOf;  // by bundle, 0 for none, and group
  for (std::uint32_t s = 0; s < volume.groups.size(); ++s) {
    const auto found = bundleOf.find(rest.strandInGroom[s]);
    const std::uint32_t bundle = found == bundleOf.end() ? 0 : found->second;
    volume.isIn[s] = volume.isIn[s] && bundle == 0;
    volume.hasBundles = volume.hasBundles || bundle > 0;
    volume.groups[s] = firstOf.try_emplace({bundle, bundle > 0 ? 0 : volume.groups[s]}, s).first->second;
  }
}

}  // namespace

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
  if (settings.bundles) takeOut(*settings.bundles, rest, volume);
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
