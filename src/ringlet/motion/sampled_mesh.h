// SampledMesh: a mesh whose points are known at some times: a point cache, a sequence of files, samples of
// USD. Between two samples points go on straight lines, and so do the columns of what places them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/motion/affine.h"
#include "ringlet/motion/mesh_motion.h"

namespace ringlet {

/// Samples of points, without a topology.
struct PointSamples {
  std::size_t pointCount = 0;
  std::vector<double> seconds{};       // of each sample, rising
  std::vector<Vec3f> points{};         // pose by pose, in the file's unit and axes
  std::vector<std::uint32_t> poses{};  // which of these each sample has; empty: one after the other
};

/// What places all points at some times.
struct PlacementSamples {
  std::vector<double> seconds{0};  // of each sample, rising
  std::vector<Affine> placements{Affine{}};
};

/// An Error where there are none, or not one at each time; where times do not rise or numbers are not finite.
Status checkPlacements(const PlacementSamples& placed);
/// Between two samples the columns go straight.
Affine placementAt(const PlacementSamples& placed, double t);

class SampledMesh final : public MeshMotion {
 public:
  /// A mesh that nothing but its points moves has one placement, from the file's unit and axes. Errors: no
  /// triangles, points or placements; samples of another size, that do not rise or are not finite; a triangle
  /// whose corner no sample has. Memory: 12 bytes for each point of each pose.
  static Result<SampledMesh> of(std::vector<Triangle> triangles, PointSamples samples,
                                PlacementSamples placed = {}, std::vector<std::string> warnings = {});

  const std::vector<Triangle>& triangles() const override { return triangles_; }
  std::size_t pointCount() const override { return samples_.pointCount; }
  double firstSeconds() const override;
  double lastSeconds() const override;
  const std::vector<std::string>& warnings() const override { return warnings_; }
  std::vector<Vec3d> pointsAt(double t) const override;

 private:
  SampledMesh() = default;
  const Vec3f* poseOf(std::size_t sample) const;

  std::vector<Triangle> triangles_;
  PointSamples samples_;
  PlacementSamples placed_;
  std::vector<std::string> warnings_;
};

}  // namespace ringlet
