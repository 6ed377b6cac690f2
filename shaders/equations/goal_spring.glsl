// The terms that a goal adds to a particle's velocity system, per kilogram: a spring and a damper towards a
// moving place (targeting; Iben et al. 2012, section 2, name it as an advantage of points). Implicit in the
// step:
//
//     (1 + T c + T^2 k) v+ = ... + T k (y+ - x) + c (y+ - y)
//
// k: stiffness [1/s^2], c: damping [1/s], x: the particle at the step's start, y and y+: the place at its
// start and end [m]. Mirrored by reference/equations/goal_spring.h.
#ifndef RINGLET_GOAL_SPRING
#define RINGLET_GOAL_SPRING

/// xyz: to the right-hand side [m/s]; w: to the mass. `after` is y+, `move` y+ - y.
vec4 goalPull(float k, float c, vec3 x, vec3 after, vec3 move, float T) {
  return vec4(T * k * (after - x) + c * move, T * c + T * T * k);
}

#endif
