// DenseStrands: which strands have much other hair about them, decided once in the rest pose. What is right
// for a strand among many, to meet them as a volume or by fewer particles, lets sparse hair slip.
#pragma once

#include <cstdint>
#include <vector>

#include "ringlet/rest/rest_state.h"

namespace ringlet {

/// Device order.
struct DenseStrands {
  /// Of dense strands: the first of all that hang together by cells that both are in; of others: the strand
  /// itself.
  std::vector<std::uint32_t> groups;
  std::vector<bool> isIn;  // of each strand: it is dense
};

/// The density of a strand is the harmonic mean over its particles of what is about them over what its own
/// strand is, in cells as they are without a setting. Strands of half of kDenseStrands and more that share
/// cells hang together; if the median of those has kDenseStrands, they are dense. Cost: linear in particles.
DenseStrands findDenseStrands(const RestState& rest);

DenseStrands noDenseStrands(const RestState& rest);

/// Cells for hair of contact particles of `radius` [m]: no smaller than particles along a strand want them
/// (kVolumeSpacing).
double volumeCellFor(const RestState& rest, double radius);

}  // namespace ringlet
