// Bodies in the layout of the kernels.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "layout/bodies.h"
#include "ringlet/scene/body.h"

namespace ringlet {

struct PackedBodies {
  std::vector<layout::BodyRest> rests;  // one per body
  std::vector<std::uint32_t> pairs;     // of bodies that do not bend; a corner of a grid: the distances there
                                        // and at its neighbour along x, as half floats [cells]
};

/// The bodies must pass checkBody. Cost: linear in the corners of their grids.
PackedBodies packBodies(std::span<const Body> bodies);

}  // namespace ringlet
