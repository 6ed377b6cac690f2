// Scalp: what hair of a generated head grows on and stays outside of; a sphere about the origin, or a mesh.
#pragma once

#include <memory>
#include <optional>

#include "ringlet/base/result.h"
#include "ringlet/base/vec3.h"
#include "ringlet/bodies/triangle_mesh.h"

namespace ringlet {

/// Where hair grows.
struct ScalpRoot {
  Vec3d direction{};  // from the origin, of length 1
  Vec3d position{};   // on the surface [m]
  Vec3d normal{};     // outward, of length 1
};

/// How far a place is outside the surface, and which way out is.
struct ScalpHeight {
  double height = 0;  // [m], negative inside
  Vec3d outward{};    // of length 1
};

class Scalp {
 public:
  explicit Scalp(double sphereRadius) : radius_(sphereRadius) {}
  /// Heights are those of a distance grid (bodies/mesh_grid.h): exact to a small share of a 48th of the
  /// mesh, up to a third of it away. Errors: those of makeDistanceGrid.
  static Result<Scalp> of(const TriangleMesh& mesh);

  /// On the outermost surface along a direction of length 1; none where there is no triangle. The root's own
  /// direction may differ by less than a cell.
  std::optional<ScalpRoot> rootAlong(Vec3d direction) const;
  ScalpHeight heightOf(Vec3d place) const;
  /// The place that is `height` outside, nearby.
  Vec3d raisedTo(Vec3d place, double height) const;

 private:
  struct Mesh;
  double radius_ = 0;                 // of the sphere
  std::shared_ptr<const Mesh> mesh_;  // in its place
};

}  // namespace ringlet
