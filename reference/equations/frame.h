// Frames along a strand by parallel transport. Mirrors shaders/equations/frame.glsl.
// Iben et al. 2012, section 3.2: each frame is the one before, turned by the smallest rotation that takes the
// previous smoothed direction to the next, so it never twists about the strand.
//
//     F_-1 = root frame, x = rest direction of edge 0 carried by it;   F_i = rot(x -> d_i) F_{i-1},  x = d_i
//
#pragma once

#include "reference/fields.h"

namespace ringlet::reference {

/// The smallest rotation that takes a's direction to b's. Opposite directions: a half turn about a fixed
/// perpendicular of a. A zero a or b: no turn.
///
/// With a, b of length 1 and h = a + b half way between them, the quaternion is (|h| / 2, a x h / |h|): it
/// keeps its digits near the half turn, where 1 + a . b has none left.
template <class Real>
Rotation<Real> smallestRotation(const Vector3<Real>& a, const Vector3<Real>& b) {
  const Real lengthA = a.norm(), lengthB = b.norm();
  if (!(lengthA > Real(0)) || !(lengthB > Real(0))) return Rotation<Real>::Identity();
  const Vector3<Real> from = a / lengthA, half = from + b / lengthB;
  const Real halfLength = half.norm();
  // 1e-6: below it rounding decides the direction of h in float (unit vectors are exact to about 1e-7).
  if (halfLength < Real(1e-6)) {
    const Vector3<Real> axis = from.unitOrthogonal();
    return Rotation<Real>(Real(0), axis.x(), axis.y(), axis.z());
  }
  const Vector3<Real> imaginary = from.cross(half) / halfLength;
  return Rotation<Real>(halfLength / Real(2), imaginary.x(), imaginary.y(), imaginary.z()).normalized();
}

/// F_i for every edge i from the smoothed edges d_i [any unit]. `rootDirection` is x before edge 0, already
/// carried by the root frame. A zero d_i turns nothing and leaves x as it is. The product is kept in double
/// whatever Real is: over a hundred turns its own rounding in float would be as large as what the kernels are
/// allowed.
template <class Real>
void transportFrames(const Rotation<Real>& rootFrame, const Vector3<Real>& rootDirection,
                     const Field<Real>& smoothedEdges, std::vector<Rotation<Real>>& frames) {
  frames.resize(smoothedEdges.size());
  Rotation<double> frame = rootFrame.template cast<double>();
  Vector3<double> x = rootDirection.template cast<double>();
  for (std::size_t i = 0; i < smoothedEdges.size(); ++i) {
    const Vector3<double> d = smoothedEdges[i].template cast<double>();
    frame = (smallestRotation(x, d) * frame).normalized();
    if (d.squaredNorm() > 0) x = d;
    frames[i] = frame.template cast<Real>();
  }
}

/// The frame edge i's target is carried by, F_{i-1}: edge 0 uses the scalp's own.
template <class Real>
const Rotation<Real>& frameBefore(std::size_t edge, const Rotation<Real>& rootFrame,
                                  const std::vector<Rotation<Real>>& frames) {
  return edge == 0 ? rootFrame : frames[edge - 1];
}

}  // namespace ringlet::reference
