// Every tolerance of the tests and of `ringlet conform`, each with its reason. A tolerance is a share of the
// field's scale (parity.h).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace ringlet::parity {

// One outer step, float kernel against float reference: sums along 128 edges of values rounded to 6e-8, and
// the order of operations is the kernel's own.
inline constexpr double kOneStep = 2e-6;

// The same for strands of more than 128 particles: the rounding of a chain of turns grows as the root of its
// length.
inline double oneStepOf(std::size_t particles) {
  return kOneStep * std::sqrt(std::max(1.0, static_cast<double>(particles) / 128));
}

// 30 Chebyshev iterations of point Jacobi, far from the solution: the k-th iterate changes k^2 times as much
// as the matrix does, whose entries are rounded to 6e-8.
inline constexpr double kOneStepOfThirtyChebyshev = 30 * 30 * 6e-8;

// One frame of 8 steps, float kernel against the double reference, as a share of the strand's rest arc
// length: float positions have 3e-8 of it, the springs carry the error of one step into the next.
inline constexpr double kOneFrame = 1e-5;

// One step and one frame among bodies. What touches one is held by 200 times its mass along the normal: float
// inverses of such a block are right to 200 x 6e-8 = 1.2e-5 across it, and a chain of them to some times that
// (with a weight of 50 errors are a tenth). A frame carries that into positions by T.
inline constexpr double kOneStepAmongBodies = 2.5e-4;
inline constexpr double kOneFrameAmongBodies = 1e-4;

// Residual of the velocity solve over its right-hand side. Velocities are rounded to 6e-8, L has up to 1,000
// times the mass in stiff directions, and a row has four such terms: 2.4e-4.
inline constexpr double kSolveResidual = 2.4e-4;

// A second of shaking, tips, share of the arc length: the error of a frame, carried by springs that neither
// damp it at once nor let it grow.
inline constexpr double kOneSecond = 1e-5;

// A pushed curl after 20 s: kinetic energy of the last second over the greatest. Noise in float is some
// 1e-12.
inline constexpr double kCalmEnergyRatio = 1e-8;

// The turn of a smoothed strand's frame from step to step, the device's in float against double, in degrees:
// positions are rounded to 3e-8 of the strand, edges of a 256th of it to 1e-5 and their directions as much;
// smoothing averages a few, and a chain of 256 turns adds up as their root: 1e-4 radians.
inline constexpr double kFrameTurnDegrees = 0.01;

// Half a second of shaken strands that meet, device against double, in metres: float positions a foot from
// the head are right to 3e-8, and contacts pass on what a step is off by.
inline constexpr double kMeetingMetres = 1e-6;

// Lying still: how far a particle may wander in 10 s, share of the arc length.
inline constexpr double kAtRest = 1e-5;

// A point of a hair that follows a guide, device against double, in metres: positions half a metre away are
// right to 6e-8, which turns core edges of millimetres by up to 1e-4, and with them offsets and curls of
// centimetres.
inline constexpr double kFollowMetres = 4e-6;

// Rest state, the solver's (double, stored as float) against the reference's own: rounding to float.
inline constexpr double kRestState = 1e-6;

// Exact solve in float32 after 100 shaken steps at 8 to 256 particles and K_s up to 10,000 w, in metres.
inline constexpr double kStiffSolveMetres = 1e-5;

// Measures of a curl, share of the curve's own: however it is cut, down to 4 particles a turn, they are those
// of the curve. A hundredth is what strand_measure.h promises.
inline constexpr double kSampling = 0.01;

// What is measured on a run's files against what was measured as it ran, share: positions are the same bits,
// but the head's rotation is fitted to roots in float, which are right to 6e-8 of a few centimetres apart.
inline constexpr double kMeasuredAgain = 1e-6;

}  // namespace ringlet::parity
