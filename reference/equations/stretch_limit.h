// The limit on an edge's length, and on its rate. Mirrors shaders/equations/stretch_limit.glsl.
// Iben et al. 2012, section 3.1: root to tip, an edge that is too long is shortened, and in the damping loops
// one that lengthens too fast is slowed. The paper gives no formula. Our choice: all edges as they
// are before limiting, so that the shifts are a sum along the strand.
//
//     shift = 0 up to the last pinned particle;   shift_{i+1} = shift_i + (min(1, s_max l_i / |e_i|) - 1) e_i
//     p_i += shift_i,   v_i += shift_i / T
//
// l_i is the groom's edge, not the preloaded one. e_i are the moved edges, e + T dv: taken from positions
// they would be rounded to the hair's size, and shift / T would show it.
#pragma once

#include <algorithm>

#include "reference/fields.h"

namespace ringlet::reference {

/// Shortens the edges i >= rootCount - 1 to maxStretch (s_max) times edgeLengths (l_i) [m]; movedEdges [m]
/// are those between the given positions. Without a root the first particle stays. Velocities follow the
/// shift over T [s]. Returns how many edges were too long.
template <class Real>
std::size_t limitStretch(std::size_t rootCount, Real maxStretch, Real stepSeconds,
                         const Scalars<Real>& edgeLengths, const Field<Real>& movedEdges,
                         FieldView<Real> positions, FieldView<Real> velocities) {
  if (positions.size() <= rootCount) return 0;
  std::size_t limitedCount = 0;
  Vector3<Real> shift = Vector3<Real>::Zero();
  for (std::size_t i = rootCount > 0 ? rootCount - 1 : 0; i + 1 < positions.size(); ++i) {
    const Vector3<Real>& edge = movedEdges[i];
    const Real length = edge.norm(), limit = maxStretch * edgeLengths[i];
    if (length > limit) {
      shift += (limit / length - Real(1)) * edge;
      ++limitedCount;
    }
    positions[i + 1] += shift;
    velocities[i + 1] += shift / stepSeconds;
  }
  return limitedCount;
}

/// Slows edges that would pass the limit within T at their present rate r_i = dv_i . e^_i, rates as they are
/// before:
///     shift_{i+1} = shift_i - max(0, r_i - max(0, (s_max l_i - |e_i|) / T)) e^_i,   v_i += shift_i
template <class Real>
void limitRates(std::size_t rootCount, Real maxStretch, Real stepSeconds, const Scalars<Real>& edgeLengths,
                const Field<Real>& edges, const Field<Real>& directions, FieldView<Real> velocities) {
  if (velocities.size() <= rootCount) return;
  Vector3<Real> shift = Vector3<Real>::Zero(), before = velocities[rootCount - 1];
  for (std::size_t i = rootCount - 1; i + 1 < velocities.size(); ++i) {
    const Real rate = (velocities[i + 1] - before).dot(directions[i]);
    const Real allowed = std::max(Real(0), (maxStretch * edgeLengths[i] - edges[i].norm()) / stepSeconds);
    shift -= std::max(Real(0), rate - allowed) * directions[i];
    before = velocities[i + 1];
    velocities[i + 1] += shift;
  }
}

}  // namespace ringlet::reference
