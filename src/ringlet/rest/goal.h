// Goals: places that hair is pulled to, or directions for its edges.
#pragma once

#include <cmath>
#include <vector>

#include "ringlet/groom/groom.h"
#include "ringlet/rest/material.h"
#include "ringlet/scene/goal.h"

namespace ringlet {

inline constexpr double kGoalLength = 0.01;  // [m]: a goal of strength 1 holds a particle's weight here

/// Stiffness k [1/s^2] of a goal's strength: strength times a particle's weight a centimetre.
inline double goalStiffness(double strength) { return strength * kStandardGravity / kGoalLength; }
/// Damping c [1/s] of a stiffness; a ratio of 1 is critical.
inline double goalDamping(double stiffness, double ratio) { return 2 * ratio * std::sqrt(stiffness); }

/// The groom as a goal: one entry per particle, groom order.
struct GroomGoal {
  std::vector<Vec3f> places;  // in the groom's axes [m]
  std::vector<float> shares;  // of the strand's arc: 0 at the root, 1 at the tip
};
GroomGoal goalOf(const Groom& groom);
/// The strength of each particle, for Simulation::setGoals.
std::vector<float> strengthsOf(const GroomGoal& goal, const GoalSettings& settings);

}  // namespace ringlet
