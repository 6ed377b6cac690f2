// Bodies in the layout of the kernels.
#pragma once

#include <span>
#include <vector>

#include "layout/bodies.h"
#include "ringlet/scene/body.h"

namespace ringlet {

struct PackedBodies {
  std::vector<layout::BodyRest> rests;  // one per body
  std::vector<layout::uvec4> cells;     // of all grids: a cell's eight distances as half floats, see
                                        // gridDistance
};

/// The bodies must pass checkBody. Cost: linear in the cells of their grids.
PackedBodies packBodies(std::span<const Body> bodies);

}  // namespace ringlet
