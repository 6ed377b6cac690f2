// Bodies as kernels have them.
#pragma once

#include <span>
#include <vector>

#include "layout/bodies.h"
#include "ringlet/scene/body.h"

namespace ringlet {

struct PackedBodies {
  std::vector<layout::BodyRest> rests;  // one a body
  std::vector<layout::uvec4> cells;     // of all grids: a cell's eight distances as halves, see gridDistance
};

/// The bodies pass checkBody. Cost: with the cells of their grids.
PackedBodies packBodies(std::span<const Body> bodies);

}  // namespace ringlet
