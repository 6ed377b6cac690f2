// UsdBlendShapes: shifts of a mesh's points by the BlendShape prims it names, weighted over time by a
// SkelAnimation.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/base/vec3.h"
#include "ringlet/motion/usd_prims.h"
#include "ringlet/motion/usd_track.h"

namespace ringlet {

class UsdBlendShapes {
 public:
  /// Those of a Mesh prim; without an animation, and where it names no weight, they do nothing, with a
  /// warning. Warned of as well: inbetween shapes, which are left out. Errors, with the prim's path: targets
  /// that are no BlendShape prims, or another number of them than of names; offsets and points that do not
  /// fit each other or the mesh; samples of weights that do not fit their names; numbers that are not finite.
  static Result<UsdBlendShapes> of(const UsdPrims& prims, std::uint32_t mesh, std::size_t pointCount,
                                   std::optional<std::uint32_t> animation,
                                   std::vector<std::string>& warnings);

  bool isEmpty() const { return shapes_.empty(); }
  /// Of the weights; null without shapes.
  const std::vector<double>* seconds() const { return isEmpty() ? nullptr : &weights_->seconds(); }
  /// Adds the offsets of all shapes. Time: linear in these.
  void addTo(std::vector<Vec3d>& points, double seconds) const;

 private:
  struct Offset {
    std::uint32_t point = 0;
    Vec3f shift{};
  };
  struct Shape {
    std::vector<Offset> offsets{};
    std::vector<std::uint32_t> weights{};  // their numbers in the animation, which add up
  };

  static Result<Shape> readShape(const UsdPrims& prims, std::uint32_t prim, std::size_t pointCount);

  std::vector<Shape> shapes_;  // those that the animation weights
  std::optional<UsdTrack> weights_;
};

}  // namespace ringlet
