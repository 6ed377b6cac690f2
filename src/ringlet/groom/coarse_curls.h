// Curls that are cut too coarsely: with fewer than four particles a turn the rest shape is no curl any more.
#pragma once

#include <span>

#include "ringlet/base/vec3.h"

namespace ringlet {

/// With which a curl keeps its shape (accuracy of the measuring and of the solver's filters). A strand is
/// coarse where it has fewer by more than a fortieth, as rounding of a generator's count leaves it.
inline constexpr double kParticlesPerTurn = 4, kLeastPerTurn = 3.9;
/// Where most joints bend by more than this a strand is a zigzag, of which nobody knows the turns: of a flat
/// ring of three and a half particles each bends by 103 degrees.
inline constexpr double kZigzagBend = 1.8;  // [rad]

/// Whether a strand is such a curl: by measureCurl, or a zigzag of eight particles and more. Cost: that of
/// measureCurl.
bool isCoarseCurl(std::span<const Vec3d> strand);

}  // namespace ringlet
