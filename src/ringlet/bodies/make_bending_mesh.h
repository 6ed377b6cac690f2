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
  Bounds grid;           // where hair can meet it; has room
  Bounds all;            // where its points come to
  int cells = 64;        // of the grid, along its longest side, 8 to 256
  bool isCloth = false;  // hair is kept off both sides; there is no grid, and hair can meet all of it
};

/// Least distance that hair keeps from cloth [m]: nearer, float32 does not tell its sides apart.
inline constexpr double kClothThickness = 5e-4;

/// For a mesh whose ways are not known: its grid is where the caller says, or about all of it and a quarter
/// of its longest side further; it may come as far away as it is large.
BendingRoom bendingRoomOf(std::span<const Vec3d> first, const std::optional<Bounds>& grid, int cells,
                          bool isCloth = false);

/// Makes `body` a mesh that bends: `first` is it before the first frame, in the frame of what carries the
/// body. Holes are closed, and a mesh that is inside out is turned; `warnings` say so, without the body's
/// name. Cloth is taken as it is, and its thickness is kClothThickness at least. Errors: those of checkMesh
/// and makeDistanceGrid, without the body's name. Cost: some 0.1 s for 5,000 triangles.
Status makeBendingMesh(TriangleMesh first, const BendingRoom& room, Body& body,
                       std::vector<std::string>& warnings);

}  // namespace ringlet
