// PoseNumbers: cheap measures of a pose: how far tips hang, how far hair is stretched.
#pragma once

#include <span>

#include "ringlet/base/vec3.h"
#include "ringlet/groom/groom.h"

namespace ringlet {

struct PoseNumbers {
  double droop = 0;        // of tips, mean over strands, as StrandMeasure::droop [m]
  double meanStretch = 1;  // length of all edges over theirs at rest
  double maxStretch = 1;   // the most of any edge, 1 at least
};

/// points: as many as in the groom, in its order and unit, finite. headRotation: against the rest pose.
/// Edges without a length at rest do not count. Cost: 10 ns a particle.
PoseNumbers poseNumbers(const Groom& rest, std::span<const Vec3f> points, Vec3d up, Quatd headRotation);

}  // namespace ringlet
