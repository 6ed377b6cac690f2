// ShapeDistance: how far one pose of a strand is from another, as numbers without a scale, so that hair
// simulated elsewhere, of whatever unit and material, can be compared with ours.
#pragma once

#include <span>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/base/vec3.h"
#include "ringlet/measure/groom_measure.h"

namespace ringlet {

/// All of it with both roots at the origin. Distances are shares of the rest arc length. `turns` and `radius`
/// are 0 for a strand that is straight at rest.
struct ShapeDistance {
  double particles = 0;  // root mean square over arc length between corresponding particles
  double tip = 0;        // between the tips
  double core = 0;       // as `particles`, between the cores (core.h): where the strand hangs, whatever the
                         // phase of its curl
  double direction = 0;  // between the chords of the cores [degrees]
  double turns = 0;      // of the pose less those of the other, as a share of those at rest
  double radius = 0;     // the same of the mean radius
};

/// From `points` to `other`, one distance a strand. Both are in the groom's order and in one unit, and each
/// is seen from its own head, which is fitted to its roots (head_fit.h). Errors: a particle that is not
/// finite, with its strand. Cost: as GroomRuler::measure, four times.
Result<std::vector<ShapeDistance>> shapeDistances(const GroomRuler& ruler, std::span<const Vec3f> points,
                                                  std::span<const Vec3f> other, double metresPerUnit);

}  // namespace ringlet
