// makeBendingMesh: what of a body that bends stays the same, from its mesh before the first frame.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ringlet/base/bounds.h"
#include "ringlet/base/result.h"
#include "ringlet/bodies/triangle_mesh.h"
#include "ringlet/scene/body.h"

namespace ringlet {

/// Where a mesh and its grid are, in the frame of what carries the body [m].
struct BendingRoom {
  Bounds grid;     // where hair can meet it; has room
  Bounds all;      // where its points come to
  int cells = 64;  // of the grid, along its longest side, 8 to 256
};

/// For a mesh whose ways are not known: its grid is where the caller says, or about all of it and a quarter
/// of its longest side further; it may come as far away as it is large.
BendingRoom bendingRoomOf(std::span<const Vec3d> first, const std::optional<Bounds>& grid, int cells);

/// Makes `body` a mesh that bends: `first` is it before the first frame, in the frame of what carries the
/// body. Holes are closed, and a mesh that is inside out is turned; `warnings` say so, without the body's
/// name. Errors: those of checkMesh and makeDistanceGrid, without the body's name. Cost: some 0.1 s for 5,000
/// triangles.
Status makeBendingMesh(TriangleMesh first, const BendingRoom& room, Body& body,
                       std::vector<std::string>& warnings);

}  // namespace ringlet
