// Goals: places that hair is pulled to, or ways its edges are to lie.
#pragma once

#include <cmath>
#include <vector>

#include "ringlet/groom/groom.h"
#include "ringlet/rest/material.h"
#include "ringlet/rest/rest_state.h"
#include "ringlet/scene/goal.h"

namespace ringlet {

inline constexpr double kGoalLength = 0.01;  // [m]: a goal of strength 1 holds a particle's weight here

/// Stiffness k [1/s^2] of a goal's strength: strength times a particle's weight a centimetre.
inline double goalStiffness(double strength) { return strength * kStandardGravity / kGoalLength; }
/// Damping c [1/s] of a stiffness; a ratio of 1 is critical.
inline double goalDamping(double stiffness, double ratio) { return 2 * ratio * std::sqrt(stiffness); }

/// A goal of an edge in place of particles: it is pulled to a vector, as by a bend spring, with the mass of
/// its particle towards the root. A strength is in the strand's weight w, as bend stiffness is: strength w /
/// l [N/m], and damped as the bend spring is, ratio S sqrt(strength w lambda) / l [N s/m]. What makes hair
/// weigh so much is its mass M [kg]; S is its arc, l the edge [m], m the particle's mass [kg].
inline double shapeStiffness(double strength, double M, double l, double m) {
  return strength * kStandardGravity * M / (l * m);
}
inline double shapeDamping(double strength, double ratio, double M, double S, double l, double m) {
  return ratio * M * std::sqrt(strength * kStandardGravity * S) / (l * m);
}

/// What makes a goal of a strength and a damping ratio: stiffness goes with the strength, damping with its
/// root.
struct GoalUnit {
  double stiffness;  // [1/s^2]
  double damping;    // [1/s]
};
/// Of each particle, device order; of a shape that of its edge, and of a strand's last particle any.
std::vector<GoalUnit> goalUnits(const RestState& rest, bool shape);

/// The groom as a goal, one entry a particle, groom order.
struct GroomGoal {
  std::vector<Vec3f> places;  // in the groom's axes [m]
  std::vector<float> shares;  // of its strand's arc, root 0 to tip 1
};
GroomGoal goalOf(const Groom& groom);
/// One a particle, for Simulation::setGoals.
std::vector<float> strengthsOf(const GroomGoal& goal, const GoalSettings& settings);

}  // namespace ringlet
