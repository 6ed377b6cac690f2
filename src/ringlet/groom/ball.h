// The ball that points lie on: a head, from the roots of its hair.
#pragma once

#include <optional>
#include <span>

#include "ringlet/base/vec3.h"

namespace ringlet {

struct Ball {
  Vec3d middle;
  double radius = 0, rms = 0;  // rms: of the points' distances from its surface

  /// Of a point from the surface, whichever side it is on.
  double distanceTo(Vec3d point) const;
};

/// Through at least one point, by least squares (Coope 1993); of radius 0 where points are in one plane.
/// Cost: three passes.
Ball ballThrough(std::span<const Vec3d> points);

/// As roots lie on a head: all close to it, rms below `mostUneven` of the radius, and on a good part of it
/// rather than on a patch that could be flat.
bool isHead(const Ball& ball, std::span<const Vec3d> points, double mostUneven);

/// The ball of a head's size [m] on which thirty roots and more lie, which `render` shows as a head; none
/// where they do not.
std::optional<Ball> headUnder(std::span<const Vec3d> roots);

}  // namespace ringlet
