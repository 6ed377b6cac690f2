// ShapeDistance: the difference between two poses of a strand, as numbers without a unit, so that hair
// simulated elsewhere, with any unit and material, can be compared with ours.
#pragma once

#include <span>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/base/vec3.h"
#include "ringlet/measure/groom_measure.h"

namespace ringlet {

/// Both roots are moved to the origin. Distances are relative to the rest arc length. `turns` and `radius`
/// are 0 for a strand that is straight at rest.
struct ShapeDistance {
  double particles = 0;  // root mean square over arc length of the distance of corresponding particles
  double tip = 0;        // between the tips
  double core = 0;       // as `particles`, between the cores (core.h): where the strand hangs, regardless of
                         // the phase of its curl
  double direction = 0;  // between the chords of the cores [degrees]
  double turns = 0;      // turns of the pose minus those of the other, relative to rest
  double radius = 0;     // likewise for the mean radius
};

/// One distance per strand. Both poses are in the groom's order and in one unit, and each is relative to its
/// own head, whose rotation is fitted to the roots (head_fit.h). Errors: a particle that is not finite, with
/// its strand. Cost: that of GroomRuler::measure, four times.
Result<std::vector<ShapeDistance>> shapeDistances(const GroomRuler& ruler, std::span<const Vec3f> points,
                                                  std::span<const Vec3f> other, double metresPerUnit);

}  // namespace ringlet
