// GoalUnits: what a goal's strength and damping ratio come to, for each particle or edge.
#pragma once

#include <vector>

#include "ringlet/rest/goal.h"
#include "ringlet/rest/rest_state.h"

namespace ringlet {

/// Of a strength and a damping ratio of 1. Stiffness goes with the strength; damping with the ratio and the
/// strength's root.
struct GoalUnit {
  double stiffness;  // k [1/s^2]
  double damping;    // c [1/s]
};

/// Of each particle, device order. Goals of places: as rest/goal.h says. Goals of shapes pull the particle's
/// edge tipward to a vector, with the particle's mass m, as a bend spring would whose stiffness is the
/// strength: with w [N] per edge length l, damped by S sqrt(w lambda) per edge length (rest/material.h); of a
/// strand's last particle the unit is of no use.
std::vector<GoalUnit> goalUnits(const RestState& rest, bool shape);

}  // namespace ringlet
