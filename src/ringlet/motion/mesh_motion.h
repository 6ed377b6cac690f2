// MeshMotion: a mesh over time, whose points move and whose triangles stay the same: the one source of points
// for scalps. Files of it are motion/mesh_motion_file.h's.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "ringlet/base/vec3.h"

namespace ringlet {

class MeshMotion {
 public:
  using Triangle = std::array<std::uint32_t, 3>;

  virtual ~MeshMotion() = default;

  /// Indices of points, counter-clockwise seen from outside.
  virtual const std::vector<Triangle>& triangles() const = 0;
  virtual std::size_t pointCount() const = 0;
  /// The times of the first and the last key or sample [s].
  virtual double firstSeconds() const = 0;
  virtual double lastSeconds() const = 0;
  /// What of the mesh was left out or taken for granted; a sentence each.
  virtual const std::vector<std::string>& warnings() const = 0;

  /// All points in the world at time t [m]; before the first key and after the last they stay. Cost: linear
  /// in points.
  virtual std::vector<Vec3d> pointsAt(double t) const = 0;

 protected:
  MeshMotion() = default;
  MeshMotion(const MeshMotion&) = default;
  MeshMotion(MeshMotion&&) = default;
  MeshMotion& operator=(const MeshMotion&) = default;
  MeshMotion& operator=(MeshMotion&&) = default;
};

}  // namespace ringlet
