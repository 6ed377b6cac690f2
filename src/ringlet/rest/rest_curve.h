// The smoothed curve of a strand at rest and the frames transported along it: the same equations as in a
// step, in double (shaders/equations/smoothing.glsl, frame.glsl), so that a hair at rest stays at rest.
#pragma once

#include <span>
#include <vector>

#include "ringlet/base/vec3.h"

namespace ringlet {

/// Edges smoothed with weight beta from the first edge. One per edge.
std::vector<Vec3d> smoothEdges(std::span<const Vec3d> edges, double beta);

/// The frame F_{i-1} of each edge i: the identity for the first, then transported along the smoothed edges.
std::vector<Quatd> framesBeforeEdges(std::span<const Vec3d> smoothedEdges, Vec3d firstEdge);

}  // namespace ringlet
