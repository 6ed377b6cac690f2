// UsdSkin: which joints of a USD skeleton carry the points of a mesh, and by how much.
//
//   p = sum over joints of weight (bind, then inverse of the joint's bind, then the joint at that time) p0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/motion/affine.h"
#include "ringlet/motion/usd_joints.h"
#include "ringlet/motion/usd_prims.h"

namespace ringlet {

class UsdSkin {
 public:
  /// Nothing where no joints carry the mesh. Weights of a point are scaled to the sum 1. Warnings: points
  /// without weight, which stay where the bind pose has them; dual quaternions, for which this blends
  /// matrices. Errors, with the prim's path: those of UsdJoints; joints that the skeleton does not have;
  /// other counts than points; indices of no joint; numbers that are not finite; a bind matrix without an
  /// inverse.
  static Result<std::optional<UsdSkin>> of(const UsdPrims& prims, std::uint32_t mesh, std::size_t pointCount,
                                           std::optional<std::uint32_t> skeleton,
                                           std::optional<std::uint32_t> animation,
                                           std::vector<std::string>& warnings);

  /// Moves points of the mesh's space by the joints, and then by `placement` of the skeleton's space. Time:
  /// linear in joints and influences.
  void move(std::vector<Vec3d>& points, double seconds, const Affine& placement) const;

  const UsdJoints& joints() const { return joints_; }
  /// Whether it turns points inside out in the bind pose.
  bool isMirroring() const;

 private:
  struct Influence {
    std::uint32_t joint = 0;  // into bound_; one past its end: none, it stays
    double weight = 0;
  };
  struct Bound {
    std::uint32_t joint = 0;  // of the skeleton
    Affine bind{};            // from the mesh's space into the joint's
  };

  Status bindJoints(const UsdPrims& prims, std::uint32_t mesh, std::uint32_t skeleton);
  Status readInfluences(const UsdPrims& prims, const UsdProperty& indices, const UsdProperty& weights,
                        std::size_t pointCount);
  std::size_t normalizeWeights();
  Affine rigidMap(const std::vector<Affine>& maps) const;

  UsdJoints joints_;
  Affine bind_;  // of the mesh, into the skeleton's space
  std::vector<Bound> bound_;
  std::vector<Influence> influences_;
  std::size_t perPoint_ = 1;
  bool isRigid_ = false;  // all points have the influences of one
};

}  // namespace ringlet
