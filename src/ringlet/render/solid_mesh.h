// SolidMesh: a body's surface for pictures: smooth, and of triangles so small that its points stand for it as
// they throw shadows.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "ringlet/bodies/triangle_mesh.h"

namespace ringlet {

struct SolidMesh {
  std::vector<Vec3d> points;   // in the body's frame [m]
  std::vector<Vec3d> normals;  // at points, outward, of length 1
  std::vector<std::array<std::uint32_t, 3>> triangles;

  // Places evenly over the surface, each for an area about it, that throw shadows.
  struct Patch {
    Vec3d place, normal;
    double area = 0;  // [m^2]
  };
  std::vector<Patch> patches;
  // The first patches are about points; each other one is in the middle of two before it.
  std::vector<std::array<std::uint32_t, 2>> splits;

  // Of a ground only: at points, the share of what is behind it that is seen, in [0, 1].
  std::vector<double> clearness;
  bool isGround() const { return !clearness.empty(); }
  bool isCloth = false;  // its back is shaded as its front
};

/// Points that triangles share shade smoothly. Patches are at most about `longest` [m] apart, but there are
/// no more than some 100,000. The mesh has passed checkMesh.
SolidMesh solidMeshOf(const TriangleMesh& mesh, double longest = 0.004);

/// The same surface with its points elsewhere, as many [m]. Patches keep their areas. Cost: linear.
SolidMesh bent(const SolidMesh& mesh, std::vector<Vec3d> points);

/// A ground: a disc of the plane y = 0 about the origin [m], which fades towards its edge. It throws no
/// shadow. Its triangles are small near the middle: one that is partly behind a camera is not drawn.
SolidMesh groundOf(double radius);

/// A square of the plane y = 0 about the origin, seen from above [m].
TriangleMesh squareOf(double side);

}  // namespace ringlet
