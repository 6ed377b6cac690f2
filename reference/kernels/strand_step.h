// One outer step of one strand, all three integrators, in three stages: prepareStrand, solveVelocities,
// moveStrand. Between the last two strands may meet. Mirrors shaders/kernels/strand_step.comp.
// Positions are relative to the head's origin, along world axes; velocities relative to the head's
// translation. Iben et al. 2012, section 5; the implicit solve is ours.
#pragma once

#include <span>
#include <vector>

#include "reference/fields.h"
#include "reference/kernels/body_step.h"
#include "reference/rest_strand.h"
#include "reference/strand_solve.h"
#include "ringlet/scene/force_field.h"
#include "ringlet/scene/settings.h"
#include "ringlet/scene/wind.h"

namespace ringlet::reference {

/// What the head, and the strand's own pose in its frame, do in the step from n to n + 1.
template <class Real>
struct HeadStep {
  Rotation<double> before, now,
      next;  // rotations of poses n - 1, n, n + 1: their differences over T need the digits
  Vector3<Real> velocityChange;  // of its translation: V_{n+1} - V_n [m/s]
  Real seconds = 0;              // T
  // Where the groom's origin is carried to, poses n and n + 1, relative to the head's origin, world axes [m].
  Vector3<double> originNow = Vector3<double>::Zero(), originNext = Vector3<double>::Zero();
  // Where the strand's roots are beside that, poses n and n + 1, the groom's axes [m].
  Vector3<double> shiftNow = Vector3<double>::Zero(), shiftNext = Vector3<double>::Zero();

  Rotation<Real> rotation() const { return now.template cast<Real>(); }
  /// Velocity of an edge x of the groom that the head carries, in the step from n - 1 to n [m/s].
  Vector3<Real> carriedEdgeVelocityBefore(const Vector3<Real>& x) const {
    return velocityBetween(before * x.template cast<double>(), now * x.template cast<double>());
  }
  /// Where the head and the shift carry a pinned particle x of the groom to [m], and how fast [m/s].
  Vector3<Real> carriedPlace(const Vector3<Real>& x) const {
    return originNext.template cast<Real>() +
           next.template cast<Real>() * Vector3<Real>(x + shiftNext.template cast<Real>());
  }
  Vector3<Real> carriedVelocity(const Vector3<Real>& x) const {
    return velocityBetween(originNow + now * (x.template cast<double>() + shiftNow),
                           originNext + next * (x.template cast<double>() + shiftNext));
  }

 private:
  Vector3<Real> velocityBetween(const Vector3<double>& from, const Vector3<double>& to) const {
    return ((to - from) / static_cast<double>(seconds)).template cast<Real>();
  }
};

/// The air in a step.
template <class Real>
struct AirStep {
  const AirSettings* settings = nullptr;       // none: a vacuum
  Vector3<Real> wind = Vector3<Real>::Zero();  // without turbulence, relative to the head's translation [m/s]
  std::span<const WindMode> modes;
  Vector3<double> origin = Vector3<double>::Zero();  // where the head is when the step starts [m]
  double seconds = 0;                                // when it ends
};

/// Every intermediate of a strand's step, N particles or N - 1 edges, for comparison with the shader's taps.
template <class Real>
struct StrandTaps {
  Field<Real> smoothedEdges;           // d_i, with alpha_b [m]
  Field<Real> coreEdges;               // b_i, with alpha_c [m]
  std::vector<Rotation<Real>> frames;  // F_i
  Field<Real> targets;                 // t_i [m]
  Field<Real> stretchForces;           // elastic [N]
  Field<Real> bendForces;              // elastic [N]
  Field<Real> coreForces;              // with the blend's scale; paper: elastic only, not transposed [N]
  Real coreScale = 1;                  // the blend's scale [1]
  Field<Real> solvedVelocities;        // after the velocity solve [m/s]
  Field<Real> positions;               // after the stretch limit [m]
  Field<Real> velocities;              // after the stretch limit [m/s]
  std::size_t limitedCount = 0;        // edges the stretch limit shortened
  std::size_t degenerateCount = 0;     // edges of length 0 at the start of the step
  Real maxEdgeStretch = 0;             // max |e_i| / l_i after the limit [1]
};

/// Memory a step needs beyond its taps, shared by strands and kept between steps.
template <class Real>
struct StepScratch {
  Field<Real> edges, directions;                                 // e_i [m], e^_i [1]
  Field<Real> movedEdges;                                        // e_i after p += T v [m]
  Field<Real> velocityDifferences, smoothedVelocityDifferences;  // dv_i, nu_i [m/s]
  Field<Real> starts;                                            // positions before the move [m]
  std::vector<BodyPush<Real>> pushes;                            // of bodies
  Field<Real> edgeForces;  // per edge, before they go to the particles [N]
  SolveScratch solve;
  Field<double> solved;  // velocities in the solve's double [m/s]
};

/// dv_i = v_{i+1} - v_i, or edges from positions.
template <class Real>
void differences(FieldView<Real> values, Field<Real>& result) {
  result.resize(values.empty() ? 0 : values.size() - 1);
  for (std::size_t i = 0; i < result.size(); ++i) result[i] = values[i + 1] - values[i];
}

/// Forces from outside on a strand's particles, on each kilogram [m/s^2]; or none.
using OutsideForces = std::span<const Vector3<double>>;

/// Places that a strand's particles are pulled to, in the groom's axes at the step's start and end [m], and
/// how hard: k [1/s^2], c [1/s]; or none.
struct GoalStep {
  Field<double> before, after;
  std::vector<double> stiffness, damping;
};

/// Fields in a step, in the world, and what velocities are relative to there; or none.
struct FieldStep {
  std::span<const ForceField> fields;
  Vector3<double> origin = Vector3<double>::Zero();  // where the head is when the step starts [m]
  Vector3<double> travel = Vector3<double>::Zero();  // the head's [m/s]
};

/// Sum of the forces on particle i [N]: +f_i of the edge below it, -f_{i-1} of the edge above.
template <class Real>
Vector3<Real> particleForce(const StrandTaps<Real>& taps, std::size_t i);

/// All that a step needs before velocities are sought: the new frame of reference, the strand's shape, its
/// forces, the velocities of pinned particles and, but for the paper's loops, the system.
template <class Real>
void prepareStrand(const RestStrand<Real>& rest, const Settings& settings, const HeadStep<Real>& head,
                   const AirStep<Real>& air, OutsideForces forces, const GoalStep& goals,
                   const FieldStep& fields, FieldView<Real> positions, FieldView<Real> velocities,
                   StepScratch<Real>& scratch, StrandTaps<Real>& taps, StrandSystem& system);

/// Integrator::jacobi: the strand as block; where that would go into a body once more, and again with
/// friction.
template <class Real>
void solveAmongBodies(const RestStrand<Real>& rest, const std::vector<BodyStep<Real>>& bodies,
                      FieldView<Real> positions, const StrandSystem& system, StepScratch<Real>& scratch,
                      FieldView<double> velocities);

/// The new velocities of the free particles; the pinned ones are already there.
template <class Real>
void solveVelocities(const RestStrand<Real>& rest, const Settings& settings, const HeadStep<Real>& head,
                     OutsideForces forces, const std::vector<BodyStep<Real>>& bodies,
                     const StrandSystem& system, StepScratch<Real>& scratch, const StrandTaps<Real>& taps,
                     FieldView<Real> positions, FieldView<Real> velocities);

/// p += T v with the new velocities, then the stretch limit, then out of bodies.
template <class Real>
void moveStrand(const RestStrand<Real>& rest, const Settings& settings, const HeadStep<Real>& head,
                const std::vector<BodyStep<Real>>& bodies, FieldView<Real> positions,
                FieldView<Real> velocities, StepScratch<Real>& scratch, StrandTaps<Real>& taps);

}  // namespace ringlet::reference
