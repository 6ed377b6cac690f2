// A goal pulls a particle to a place that moves: targeting, which Iben et al. 2012, section 2, name as what a
// point representation is good for. A spring and a damper on each kilogram,
//
//     a = k (y - x) + c (y' - v)
//
//     x, v    the particle [m], [m/s]
//     y, y'   the place and its velocity
//     k, c    stiffness [1/s^2], damping [1/s]
//
// and implicit, with the place at the step's end, y+, and its way in the step, y+ - y = T y':
//
//     (1 + T c + T^2 k) v+ = ... + T k (y+ - x) + c (y+ - y)
//
// so that a goal of any strength is stable: for k without bounds x + T v+ is y+. Mirrors
// shaders/equations/goal_spring.glsl.
#pragma once

#include "reference/fields.h"

namespace ringlet::reference {

/// What is added to the velocity system of a particle of a kilogram.
template <class Real>
struct GoalPull {
  Real weight = 0;         // to the mass [1]
  Vector3<Real> momentum;  // to the right-hand side [m/s]
};

/// x at the step's start, the place at its start and end [m]; T: of the step [s].
template <class Real>
GoalPull<Real> goalPull(Real k, Real c, const Vector3<Real>& x, const Vector3<Real>& before,
                        const Vector3<Real>& after, Real T) {
  return {T * c + T * T * k, T * k * (after - x) + c * (after - before)};
}

}  // namespace ringlet::reference
