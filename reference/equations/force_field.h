// A field of force, or of air that moves: Iben et al. 2012, section 2, name the "easy integration of external
// forces" as what a point representation is good for. At a place x, with
//
//     q       from the field's place p to x, or the part of that across the axis a
//     s       sqrt(q^2 + core^2), so that the field is smooth where q vanishes
//     w       its weight: it fades to nothing at `reach`, and before and behind a shell at `front`
//
//     F = axial a + radial q / s + around (a x q) / s + grid(x)
//     w = (1 - (|q| / reach)^2)^2 (1 - ((|q| - front) / thickness)^2)^2
//
// Without drag w F is an acceleration [m/s^2]. With drag c [1/s] F is the velocity of the air and the
// acceleration w c (F - v), implicit:
//
//     (1 + T w c) v+ = ... + T w c F
//
// so that no drag is too strong. Mirrors shaders/equations/force_field.glsl.
#pragma once

#include <algorithm>
#include <cmath>

#include "reference/equations/goal_spring.h"
#include "reference/fields.h"
#include "ringlet/scene/force_field.h"

namespace ringlet::reference {

/// From the field's place, or from its axis, to x in the world [m].
inline Vector3<double> fieldArm(const ForceField& field, const Vector3<double>& x) {
  const Vector3<double> q = x - toEigen<double>(field.place.position);
  const Vector3<double> a = toEigen<double>(worldAxis(field));
  return field.aboutAxis ? Vector3<double>(q - a * a.dot(q)) : q;
}

/// (1 - u^2)^2 within 1, then 0.
inline double fadedTo1(double u) { return std::pow(std::max(0.0, 1 - u * u), 2); }

/// At the distance d [m].
inline double fieldWeight(const ForceField& field, double d) {
  return (field.reach > 0 ? fadedTo1(d / field.reach) : 1) *
         (field.thickness > 0 ? fadedTo1((d - field.front) / field.thickness) : 1);
}

/// Of a grid at x in the world, trilinear; nothing outside its nodes [m/s].
inline Vector3<double> gridVelocity(const ForceField& field, const Vector3<double>& x) {
  const VelocityGrid& grid = *field.grid;
  const Rotation<double> turn = toEigen<double>(field.place.rotation);
  const Vector3<double> g = turn.conjugate() * (x - toEigen<double>(field.place.position)) / grid.cell;
  std::size_t at[3];
  Vector3<double> t;
  for (int k = 0; k < 3; ++k) {
    const double last = grid.nodes[static_cast<std::size_t>(k)] - 1;
    if (!(g[k] >= 0 && g[k] <= last)) return Vector3<double>::Zero();
    at[k] = static_cast<std::size_t>(std::min(std::floor(g[k]), last - 1));
    t[k] = g[k] - static_cast<double>(at[k]);
  }
  Vector3<double> sum = Vector3<double>::Zero();
  for (std::size_t dz = 0; dz < 2; ++dz)
    for (std::size_t dy = 0; dy < 2; ++dy)
      for (std::size_t dx = 0; dx < 2; ++dx) {
        const double share = (dx ? t[0] : 1 - t[0]) * (dy ? t[1] : 1 - t[1]) * (dz ? t[2] : 1 - t[2]);
        const std::size_t node = ((at[2] + dz) * grid.nodes[1] + at[1] + dy) * grid.nodes[0] + at[0] + dx;
        sum += share * toEigen<double>(grid.velocities[node]);
      }
  return turn * sum;
}

/// F, without the weight: [m/s^2], or with drag [m/s].
inline Vector3<double> fieldStrength(const ForceField& field, const Vector3<double>& x) {
  const Vector3<double> q = fieldArm(field, x), a = toEigen<double>(worldAxis(field));
  const double s = std::sqrt(q.squaredNorm() + field.core * field.core);
  const Vector3<double> n = s > 1e-10 ? Vector3<double>(q / s) : Vector3<double>::Zero();
  Vector3<double> strength = field.axial * a + field.radial * n + field.around * a.cross(n);
  if (field.grid) strength += field.gridShare * gridVelocity(field, x);
  return strength;
}

/// What is added to the velocity system of a particle of a kilogram at x in the world, in a step of T [s];
/// velocities are relative to what travels with `travel` [m/s].
inline GoalPull<double> fieldPull(const ForceField& field, const Vector3<double>& x,
                                  const Vector3<double>& travel, double T) {
  const double w = fieldWeight(field, fieldArm(field, x).norm());
  const Vector3<double> strength = fieldStrength(field, x);
  if (field.drag == 0) return {0, T * w * strength};
  return {T * w * field.drag, T * w * field.drag * (strength - travel)};
}

}  // namespace ringlet::reference
