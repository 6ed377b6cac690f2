// Particles that are thrown off their strand, alone, to a place that no other strand has: noise of a
// reconstruction. Places that exporters write for many are stray_points.h.
#pragma once

#include <vector>

#include "ringlet/groom/groom.h"

namespace ringlet {

/// A particle between two others is thrown off where both edges to it are longer than its strand's median by
/// this factor, and the particles on both sides are near each other. Real grooms have edges up to 3.6 times
/// as long.
inline constexpr double kThrownEdge = 6;
/// A root or tip, of which one edge tells less, where that edge is longer by this factor.
inline constexpr double kThrownEnd = 20;
/// Particles on both sides are near each other up to this many median edges. Without the one between them an
/// edge is two long, and uneven ones half as long again.
inline constexpr double kThrownGap = 3;

/// For each particle whether it is thrown off, and no stray. Only strands of five particles and more have
/// such. Cost: that of strayPoints.
std::vector<bool> thrownPoints(const Groom& groom);

/// Without these particles; the strands stay as many. Two particles of each are to stay.
Groom withoutPoints(const Groom& groom, const std::vector<bool>& which);

}  // namespace ringlet
