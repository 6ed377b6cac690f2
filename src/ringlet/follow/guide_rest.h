// GuideRest: a guide as it was groomed, for the hairs that follow it.
#pragma once

#include <span>
#include <vector>

#include "ringlet/base/vec3.h"
#include "ringlet/measure/core.h"

namespace ringlet {

struct GuideRest {
  std::vector<double> arcs;  // where its particles stand, from 0 at the root [m]
  double window = 0;         // what its core is smoothed over [m]
  Vec3d root;                // [m]
  MeasuringFrame frame;      // of its core at the root
};

/// Of a strand's rest points [m], at least two and not all in one place. Cost: n log n.
GuideRest restOfGuide(std::span<const Vec3d> strand);

/// Takes x, y and z to the frame's normal, binormal and tangent.
Quatd quaternionOf(const MeasuringFrame& frame);

}  // namespace ringlet
