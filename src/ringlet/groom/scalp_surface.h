// ScalpSurface: what hair of a generated head grows on and stays outside of. A sphere about the origin, or a
// mesh (bodies/mesh_scalp.h).
#pragma once

#include <optional>

#include "ringlet/base/vec3.h"

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

class ScalpSurface {
 public:
  virtual ~ScalpSurface() = default;

  /// On the outermost surface along a direction of length 1; none where there is none. The root's own
  /// direction may differ a little.
  virtual std::optional<ScalpRoot> rootAlong(Vec3d direction) const = 0;
  virtual ScalpHeight heightOf(Vec3d place) const = 0;
  /// The place that is `height` outside, nearby.
  virtual Vec3d raisedTo(Vec3d place, double height) const = 0;
};

class SphereScalp final : public ScalpSurface {
 public:
  explicit SphereScalp(double radius) : radius_(radius) {}  // [m]

  std::optional<ScalpRoot> rootAlong(Vec3d direction) const override {
    return ScalpRoot{direction, direction * radius_, direction};
  }
  ScalpHeight heightOf(Vec3d place) const override {
    return {length(place) - radius_, normalizedOr(place, Vec3d{0, 1, 0})};
  }
  Vec3d raisedTo(Vec3d place, double height) const override {
    return normalizedOr(place, Vec3d{0, 1, 0}) * (radius_ + height);
  }

 private:
  double radius_;
};

}  // namespace ringlet
