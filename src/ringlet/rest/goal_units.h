// GoalUnits: conversion of a goal's strength and damping ratio to stiffness and damping, per particle or
// edge.
#pragma once

#include <span>
#include <vector>

#include "ringlet/rest/goal.h"
#include "ringlet/rest/rest_state.h"

namespace ringlet {

/// Stiffness and damping at strength 1 and damping ratio 1. Stiffness is proportional to the strength,
/// damping to the ratio and to the square root of the strength.
struct GoalUnit {
  double stiffness;  // k [1/s^2]
  double damping;    // c [1/s]
};

/// One per particle, device order. With goals of places: as rest/goal.h says. Goals of shapes pull a
/// particle's tipward edge to a vector, using the particle's mass m, like a bend spring whose stiffness is
/// the strength: with w [N] per edge length l, damped by S sqrt(w lambda) per edge length (rest/material.h);
/// the unit of a strand's last particle is not used.
std::vector<GoalUnit> goalUnits(std::span<const layout::StrandRest> strands,
                                std::span<const layout::ParticleRest> particles, bool shape);

}  // namespace ringlet
