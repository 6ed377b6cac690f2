// The film that closes the holes of a mesh, and how far places are from it.
#pragma once

#include <vector>

#include "ringlet/scene/distance_grid.h"

namespace ringlet {

/// Where the winding number passes 1/2 between two corners although no triangle is near enough to be between
/// them, a hole is closed. Lowers `magnitudes` [m], the unsigned distances to the triangles, to the distance
/// to that film where it is nearer: to second order beside the film, to first order (fast sweeping: Zhao, "A
/// fast sweeping method for eikonal equations", 2005) elsewhere. `windings` holds the winding number of every
/// corner, positive where the mesh is not inside out. `grid` says where the corners are; its distances are
/// not read.
void closeHoles(const DistanceGrid& grid, const std::vector<float>& windings, std::vector<float>& magnitudes);

}  // namespace ringlet
