// Where on a generated head a direction from its middle is: hairline, fringe, parting, top, sides and back.
#pragma once

#include "ringlet/base/vec3.h"
#include "ringlet/groom/generate.h"

namespace ringlet {

/// 0 up to `low`, 1 from `high` on, with slopes of 0 at both.
double smoothstep(double low, double high, double x);

/// Whether hair grows there. outward: of length 1, above the cap that the two elevations of `head` bound.
bool isAboveHairline(const HeadParameters& head, Vec3d outward);

/// Whether its hair is the fringe's.
bool isFringe(const HeadParameters& head, Vec3d outward);

/// The factor of top, sides, back and layers on the length of hair from there.
double lengthFactor(const HeadParameters& head, Vec3d outward);

/// +1 left of the parting, -1 right of it, as the head sees it; 0 without a parting.
int sideOfParting(const HeadParameters& head, Vec3d outward);

}  // namespace ringlet
