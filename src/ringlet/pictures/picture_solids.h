// PictureSolids: what stands in a picture beside the hair: the bodies of a scene, or else a head for hair
// whose roots lie on a ball; and a ground.
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
  /// The bodies of a scene, which must live as long. `hairSize`: of all hair [m]; a plane is shown some way
  /// beyond.
  static PictureSolids ofScene(const LoadedScene& scene, double hairSize);
  /// A head under hair with these roots [m], at rest; nothing where they are on no ball of a head's size.
  /// `up`: of the groom.
  static PictureSolids ofRoots(std::span<const Vec3d> roots, Vec3d up);

  /// A ground that far along the up axis, about `middle` [m]. It takes shadows and throws none.
  void addGround(double height, double radius, Vec3d middle, Vec3d up);
  /// How far down everything but planes and the ground comes along the up axis, where it stands so; infinity
  /// where there is nothing.
  double lowest(std::span<const SolidPlace> places, Vec3d up) const;

  const std::vector<SolidMesh>& meshes() const { return meshes_; }
  /// The body of the scene that each mesh is; empty without a scene.
  const std::vector<std::size_t>& bodies() const { return bodies_; }
  /// At the end of a frame, from 1, or a share of one before; `roots` as they are then [m], in the order of
  /// those at rest, and how the head has turned.
  std::vector<SolidPlace> placesAt(double frame, std::span<const Vec3d> roots, Quatd head) const;

 private:
  std::vector<SolidPlace> bodiesAt(double frame, std::span<const Vec3d> roots, Quatd head) const;

  const LoadedScene* scene_ = nullptr;
  std::vector<SolidMesh> meshes_;
  std::vector<std::size_t> bodies_;  // of the scene, one a mesh
  Vec3d fromRoots_{};                // of the head's ball, from the mean of the roots at rest
  Quatd upright_{};
  std::optional<SolidPlace> ground_;
};

}  // namespace ringlet
