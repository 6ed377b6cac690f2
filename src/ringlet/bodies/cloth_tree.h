// The tree of boxes in which kernels find the triangles of cloth (shaders/layout/mesh_fields.h). Which
// triangles a node has follows from their number alone; their order makes those of a node neighbours.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "ringlet/base/vec3.h"

namespace ringlet {

/// The triangles in an order in which those of each node of the tree are close to each other: halved again
/// and again across the longest side of the box about their middles. Cost: n log n.
std::vector<std::array<std::uint32_t, 3>> orderedAsTree(std::vector<std::array<std::uint32_t, 3>> triangles,
                                                        std::span<const Vec3d> points);

}  // namespace ringlet
