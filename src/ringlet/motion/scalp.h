// Scalp: strands' roots on a mesh that moves and bends. Every root is bound to the triangle nearest to it and
// carried rigidly with that triangle's frame:
//
//        c           z: the normal          x(t) = position + rotate(rotation, x(t0))
//       / \  .root   x: along the first
//      /   \            edge, a to b        for the root and all around it
//     a-----b
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/motion/mesh_motion.h"
#include "ringlet/scene/head_pose.h"

namespace ringlet {

class Scalp {
 public:
  /// `roots` in the world as they are at t0 of the mesh's time [m, s]. An Error counts those that are further
  /// than `farthest` [m] from every triangle, or not finite, and names the worst.
  static Result<Scalp> bind(std::shared_ptr<const MeshMotion> mesh, std::span<const Vec3d> roots, double t0,
                            double farthest);

  /// The rigid motion of each root since t0: all are HeadPose{} at t0. Where a triangle loses its area its
  /// frame is any across what is left of it. Cost: linear in roots and mesh.
  std::vector<HeadPose> posesAt(double t) const;

  const std::shared_ptr<const MeshMotion>& mesh() const { return mesh_; }
  std::size_t rootCount() const { return bindings_.size(); }
  /// The triangle a root is bound to.
  std::size_t triangleOf(std::size_t root) const { return bindings_[root].triangle; }
  /// From the mesh at t0, of the root farthest from it [m].
  double farthestRoot() const { return farthestRoot_; }

 private:
  struct Binding {
    std::size_t triangle = 0;
    std::array<double, 3> weights{};
    Vec3d anchor;        // on the triangle, at t0
    Quatd inverseFrame;  // of the triangle, at t0
  };

  Scalp() = default;

  std::shared_ptr<const MeshMotion> mesh_;
  std::vector<Binding> bindings_;
  double farthestRoot_ = 0;
};

}  // namespace ringlet
