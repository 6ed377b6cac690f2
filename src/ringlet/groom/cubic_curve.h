// Cubic curves in pieces, as USD's BasisCurves are, made into strands of particles.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "ringlet/base/vec3.h"

namespace ringlet {

enum class CubicBasis { bezier, bspline, catmullRom };

/// How far a strand may be from its curve, as a share of the curve's length: a quarter of a millimetre of
/// hair of 25 cm, where the tightest curls have a radius of 3 mm.
inline constexpr double kCubicTolerance = 1e-3;

/// Whether so many points make a curve: four, and of a Bezier curve three more for each further piece.
/// Pinned, which Bezier curves never are, two.
bool isCubicCount(CubicBasis basis, bool isPinned, std::size_t count);

/// Appends the particles. Each piece becomes as many edges, of equal steps of its parameter: the fewest, 28
/// at most, with which the strand stays within the tolerance. A B-spline or Catmull-Rom curve that is not
/// pinned begins and ends short of its first and last points, as its definition has it. Points of any size
/// below 1e300; their count makes a curve.
void appendCubic(std::span<const Vec3d> points, CubicBasis basis, bool isPinned,
                 std::vector<Vec3d>& particles);

/// Whether these are knots of a cubic B-spline of so many points, four at least: four more, finite, none
/// below the one before, and with a span between the fourth and the fourth last.
bool areCubicKnots(std::span<const double> knots, std::size_t count);

/// Appends the points of the Bezier curve that a cubic B-spline with knots is: where the first and last four
/// are the same, one that begins and ends at its points. The knots are its own.
void appendBezierOfKnots(std::span<const Vec3d> points, std::span<const double> knots,
                         std::vector<Vec3d>& bezier);

}  // namespace ringlet
