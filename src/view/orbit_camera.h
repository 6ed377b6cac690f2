// OrbitCamera: a camera that the mouse takes around what it looks at; and what lies under the mouse.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "ringlet/base/vec3.h"
#include "ringlet/render/camera.h"
#include "ringlet/render/hair_renderer.h"
#include "ringlet/render/solid_mesh.h"

namespace ringlet::view {

/// A half line; `along` has length 1.
struct Ray {
  Vec3d from, along;
};

class OrbitCamera {
 public:
  /// Shows the points, at least one; `up` is Y or Z.
  OrbitCamera(std::span<const Vec3d> points, Vec3d up, double aspect);

  const Camera& camera() const { return camera_; }
  /// To where it was at first.
  void home() { camera_ = first_; }
  /// Around the target: by angles [rad], to the right and up. It stops short of the poles.
  void orbit(double right, double up);
  /// Along the picture: by pixels of one that is so many high. What is at the target's distance goes along.
  void pan(double right, double down, int height);
  /// Nearer: by a factor on the distance.
  void zoom(double factor);

  /// Through a place of a picture, 0 to 1 across and down, whose width is `aspect` times its height.
  Ray rayThrough(double across, double down, double aspect) const;
  /// Of something at a place: how far it goes in the world as it goes along the picture by pixels.
  Vec3d moveOf(Vec3d place, double right, double down, int height) const;
  /// Where a place of the world is in a picture of that size [pixels]; none behind the camera.
  std::optional<Vec3d> project(Vec3d place, int width, int height) const;

 private:
  Camera camera_, first_;
};

/// The nearest of these solids that the ray hits.
struct Hit {
  std::size_t solid = 0;
  Vec3d place;
};
std::optional<Hit> hitBy(const Ray& ray, std::span<const SolidMesh> solids,
                         std::span<const SolidPlace> places);

}  // namespace ringlet::view
