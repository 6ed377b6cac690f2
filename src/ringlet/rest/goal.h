// Goals: places that hair is pulled to, or ways its edges are to lie.
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

/// The groom as a goal, one entry a particle, groom order.
struct GroomGoal {
  std::vector<Vec3f> places;  // in the groom's axes [m]
  std::vector<float> shares;  // of its strand's arc, root 0 to tip 1
};
GroomGoal goalOf(const Groom& groom);
/// One a particle, for Simulation::setGoals.
std::vector<float> strengthsOf(const GroomGoal& goal, const GoalSettings& settings);

}  // namespace ringlet
