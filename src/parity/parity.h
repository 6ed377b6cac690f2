// Parity: random valid grooms and states from fixed seeds, one step of them on the device (with taps) and in
// the reference, and the comparison field by field. An error is a share of the field's scale: positions by
// rest arc length, edges and targets by mean edge length, forces by stiffness times edge length, velocities
// by the largest speed, frames by 1; forces cancel, so an error relative to each value would mean nothing.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "ringlet/groom/groom.h"
#include "ringlet/rest/material.h"
#include "ringlet/scene/head_pose.h"
#include "ringlet/scene/settings.h"
#include "ringlet/solver/simulation.h"

namespace ringlet::parity {

/// One helix, in metres, hanging from the origin: radius and length [m]; `noise` [m] moves each particle at
/// random.
std::vector<Vec3f> helix(int particles, double radius, double length, double turns, double noise,
                         std::uint32_t seed);

/// Curls, waves and straight strands of the given particle counts, about 25 cm long, in metres; a fixed seed.
Groom randomGroom(const std::vector<int>& particleCounts, std::uint32_t seed);

/// Strands swung along smooth waves, at about 1 m/s, with noise on top: a hundredth of an edge and a
/// hundredth of the speed. No edge is beyond the stretch limit before the step, many are after it; pinned
/// particles stay.
HairState randomState(const Groom& groom, const Settings& settings, std::uint32_t seed);

/// A material that differs from strand to strand and from root to tip.
Material varyingMaterial();

/// A field of every kind about a place, with a grid, some that move, at a time [s].
std::vector<ForceField> sampleFields(const Vec3d& about, double seconds);

struct FieldError {
  std::string field;
  double error = 0;   // largest, share of scale
  std::string where;  // strand, particle, expected, found
};

struct ParityCase {
  Groom groom;
  Material material;
  Settings settings;  // stepsPerFrame is taken as 1
  KernelChoice kernel;
  std::uint32_t seed = 1;
  // With kernel.features.roots every strand has small poses of its own, with kernel.features.forces every
  // particle a force of a few times its weight, with kernel.features.goals a place that it is pulled to, at
  // random; with kernel.features.fields, sampleFields().
  std::vector<Body> bodies{};
  // Made one after the other before the first step. Of what falls positions and velocities are compared.
  std::vector<std::vector<StrandCut>> cuts{};
  Quatd turned{};            // of the head before it moves
  bool shiftsRoots = false;  // each root its own way beside the head, while that moves; not with movingRoots
};

/// All fields of one step, device against reference::Simulation<float>, from the same random state. `report`:
/// what the device then reports.
std::vector<FieldError> oneStepErrors(const ComputeDevice& device, ParityCase parityCase,
                                      SimulationReport* report = nullptr);

/// Largest distance of positions after some frames from reference::Simulation<double>, share of the strand's
/// arc length.
FieldError oneFrameError(const ComputeDevice& device, const ParityCase& parityCase, int frameCount = 1);

/// "smoothed edges 1.2e-07, frames 3e-07, ..." for the test's log.
std::string toText(const std::vector<FieldError>& errors);

}  // namespace ringlet::parity
