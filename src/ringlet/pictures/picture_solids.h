// PictureSolids: solids in a picture besides the hair: the bodies of a scene, or else a head for hair whose
// roots lie on a ball; and a ground.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "ringlet/base/vec3.h"
#include "ringlet/render/hair_renderer.h"
#include "ringlet/scenes/load/load_scene.h"

namespace ringlet {

class PictureSolids {
 public:
  /// The bodies of a scene, which must outlive this. `hairSize`: of all hair [m]; planes are drawn some way
  /// beyond it.
  static PictureSolids ofScene(const LoadedScene& scene, double hairSize);
  /// A head for hair with these roots at rest [m]; nothing if they lie on no ball of a head's size. `up`: of
  /// the groom.
  static PictureSolids ofRoots(std::span<const Vec3d> roots, Vec3d up);

  /// Adds a ground at this height along the up axis, around `middle` [m]. It receives shadows and casts none.
  void addGround(double height, double radius, Vec3d middle, Vec3d up);
  /// Lowest point along the up axis of everything but planes and the ground, with these places; infinity if
  /// there is nothing.
  double lowest(std::span<const SolidPlace> places, Vec3d up) const;

  const std::vector<SolidMesh>& meshes() const { return meshes_; }
  /// The index of each mesh's body in the scene; empty without a scene.
  const std::vector<std::size_t>& bodies() const { return bodies_; }
  /// The places at the end of a frame, which counts from 1 and may be fractional. `roots`: present positions
  /// [m], in the order of those at rest; `head`: the rotation of the head.
  std::vector<SolidPlace> placesAt(double frame, std::span<const Vec3d> roots, Quatd head) const;

 private:
  std::vector<SolidPlace> bodiesAt(double frame, std::span<const Vec3d> roots, Quatd head) const;

  const LoadedScene* scene_ = nullptr;
  std::vector<SolidMesh> meshes_;
  std::vector<std::size_t> bodies_;  // index in the scene for each mesh
  Vec3d fromRoots_{};                // centre of the head's ball relative to the mean of the roots at rest
  Quatd upright_{};
  std::optional<SolidPlace> ground_;
};

}  // namespace ringlet
