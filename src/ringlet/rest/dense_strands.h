// DenseStrands: the strands with much other hair around them, found once in the rest pose. Only these may
// form a volume, or have fewer contact particles; strands of sparse hair would then pass through each other.
#pragma once

#include <cstdint>
#include <vector>

#include "ringlet/base/in_parallel.h"
#include "ringlet/rest/rest_state.h"

namespace ringlet {

/// Device order.
struct DenseStrands {
  /// For a dense strand the first strand of its component (strands that share cells are connected); for any
  /// other strand itself.
  std::vector<std::uint32_t> groups;
  std::vector<bool> isIn;  // whether each strand is dense
};

/// The density of a strand is the harmonic mean over its particles of the ratio of the density of all hair to
/// that of the strand alone, in cells of the default size. Strands with half of kDenseStrands or more that
/// share cells are connected. If the median strand of a component has kDenseStrands or more, the component is
/// dense. The result does not depend on threadCount. Cost: linear in particles.
DenseStrands findDenseStrands(const RestState& rest, unsigned threadCount = coreCount());

DenseStrands noDenseStrands(const RestState& rest);

/// Default cell size for hair with contact particles of `radius` [m]; not smaller than the spacing of
/// particles along a strand allows (kVolumeSpacing).
double volumeCellFor(const RestState& rest, double radius);

}  // namespace ringlet
