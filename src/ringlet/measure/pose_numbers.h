// PoseNumbers: inexpensive measures of a pose: how far tips hang, and how much hair is stretched.
#pragma once

#include <span>

#include "ringlet/base/vec3.h"
#include "ringlet/groom/groom.h"

namespace ringlet {

struct PoseNumbers {
  double droop = 0;        // of tips, mean over strands, as StrandMeasure::droop [m]
  double meanStretch = 1;  // total length of all edges relative to rest
  double maxStretch = 1;   // the largest of any edge, at least 1
};

/// points: as many as in the groom, in its order and unit, finite. headRotation: relative to the rest pose.
/// Edges without a length at rest are left out. Cost: 10 ns a particle.
PoseNumbers poseNumbers(const Groom& rest, std::span<const Vec3f> points, Vec3d up, Quatd headRotation);

}  // namespace ringlet
