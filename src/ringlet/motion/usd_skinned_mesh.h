// UsdSkinnedMesh: a mesh of a USD file that a skeleton, blend shapes or both deform: first the shapes, then
// the skeleton, which stands where its own prim is placed, wherever the mesh's prim is.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/motion/mesh_motion.h"
#include "ringlet/motion/sampled_mesh.h"
#include "ringlet/motion/usd_blend_shapes.h"
#include "ringlet/motion/usd_skin.h"

namespace ringlet {

/// What deforms a mesh; nothing, where both are empty.
struct UsdDeformers {
  UsdBlendShapes shapes{};
  std::optional<UsdSkin> skin{};
  std::uint32_t placedBy =
      kNoUsdPrim;  // the prim whose transforms place the points: the mesh or the skeleton

  bool isEmpty() const { return shapes.isEmpty() && !skin; }
  /// Whether the deformers themselves have more than one sample.
  bool move() const;
};

/// What the prims of the file say, by the mesh's own properties and by those it takes over from prims above.
/// Errors are those of UsdBlendShapes and UsdSkin, and of skeletons and animations that are not where a prim
/// says they are.
Result<UsdDeformers> readUsdDeformers(const UsdPrims& prims, std::uint32_t mesh, std::size_t pointCount,
                                      std::vector<std::string>& warnings);

class UsdSkinnedMesh final : public MeshMotion {
 public:
  /// `shape` has its points before anything deforms them, in the mesh's own space; `placed` is of the prim
  /// that places them. An Error where points at the first or last time are not finite.
  static Result<UsdSkinnedMesh> of(SampledMesh shape, UsdDeformers deformers, PlacementSamples placed);

  const std::vector<Triangle>& triangles() const override { return shape_.triangles(); }
  std::size_t pointCount() const override { return shape_.pointCount(); }
  double firstSeconds() const override { return firstSeconds_; }
  double lastSeconds() const override { return lastSeconds_; }
  const std::vector<std::string>& warnings() const override { return shape_.warnings(); }
  std::vector<Vec3d> pointsAt(double t) const override;

 private:
  UsdSkinnedMesh(SampledMesh shape, UsdDeformers deformers, PlacementSamples placed);

  SampledMesh shape_;
  UsdDeformers deformers_;
  PlacementSamples placed_;
  double firstSeconds_ = 0, lastSeconds_ = 0;
};

}  // namespace ringlet
