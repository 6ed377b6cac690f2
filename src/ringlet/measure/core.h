// The core of a strand: the curve around which its curl winds. It is found by smoothing without a phase
// shift, so that it neither lags nor leans towards the root as the solver's filter does. All measures of
// curls refer to it.
#pragma once

#include <span>
#include <vector>

#include "ringlet/base/vec3.h"
#include "ringlet/groom/curl_shape.h"

namespace ringlet {

/// The coordinate of each particle: rest arc length from the root (measureArcs), ascending [unit of the
/// points]. Particles keep these coordinates however the strand moves.
std::vector<double> arcPositions(std::span<const Vec3d> rest);

/// The arc length a strand's core is smoothed over: one turn of its rest curl, or a tenth of a straight
/// strand; at most the whole strand [unit].
double coreWindow(const CurlShape& shape, double arcLength);

/// The core, one point per particle: the mean of the strand over a window around the particle, taken twice
/// (box filter on box filter), with the polyline as a curve over `arcPositions`, so that particles may be
/// dense or sparse. For a helix with one turn per window it is the axis: exactly if a turn contains a whole
/// number of particles; otherwise, with at least 4 particles a turn, within 0.2 % of the radius, and 2 % at
/// the ends.
///
/// Ends: the first mean exists from half a window after the root to half a window before the tip; beyond, it
/// is extended straight with its own mean slope over up to one window. Shrinking the window instead would
/// pull the core onto the strand and lose half a turn at each end.
///
/// arcPositions ascends from 0; window is in (0, arcPositions.back()]. Cost: n log n.
std::vector<Vec3d> smoothCore(std::span<const Vec3d> points, std::span<const double> arcPositions,
                              double window);

/// Axes across and along the core at a particle: right-handed, of unit length.
struct MeasuringFrame {
  Vec3d normal, binormal, tangent;
};

/// A frame for each core point, by parallel transport from the first one, which is `root` turned by the
/// smallest rotation that takes its tangent to the core's.
std::vector<MeasuringFrame> framesAlong(std::span<const Vec3d> core, const MeasuringFrame& root);

/// The frame at the root of a core at rest; its normal is arbitrary, but always the same for the same core.
MeasuringFrame rootFrameOf(std::span<const Vec3d> core);

/// `frame` turned by a rotation, such as the head's.
MeasuringFrame rotated(const MeasuringFrame& frame, Quatd rotation);

}  // namespace ringlet
