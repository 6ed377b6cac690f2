// One outer step of one strand, all three integrators, in three stages: prepareStrand, solveVelocities,
// moveStrand. Between the last two strands may meet. Mirrors shaders/kernels/strand_step.comp.
// Positions are relative to the head's origin, along world axes; velocities relative to the head's
// translation. Iben et al. 2012, section 5; the implicit solve is ours.
#pragma once

#include <algorithm>

#include "reference/equations/air_drag.h"
#include "reference/equations/bend_spring.h"
#include "reference/equations/core_spring.h"
#include "reference/equations/frame.h"
#include "reference/equations/smoothing.h"
#include "reference/equations/stretch_limit.h"
#include "reference/equations/stretch_spring.h"
#include "reference/equations/turbulence.h"
#include "reference/fields.h"
#include "reference/kernels/body_step.h"
#include "reference/rest_strand.h"
#include "reference/strand_solve.h"
#include "ringlet/scene/settings.h"

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

/// Edges and smoothed edges, frames and targets: the strand's shape (sections 3.2, 3.2.1, 3.3).
template <class Real>
void measureShape(const RestStrand<Real>& rest, bool isPaper, const HeadStep<Real>& head,
                  FieldView<Real> positions, FieldView<Real> velocities, StepScratch<Real>& scratch,
                  StrandTaps<Real>& taps) {
  differences(positions, scratch.edges);
  differences(velocities, scratch.velocityDifferences);
  scratch.directions.resize(rest.edgeCount());
  taps.degenerateCount = 0;
  for (std::size_t i = 0; i < rest.edgeCount(); ++i) {
    scratch.directions[i] = directionOr(scratch.edges[i], Vector3<Real>::Zero());
    if (!(scratch.edges[i].norm() > Real(0))) ++taps.degenerateCount;
  }

  // The filters start from the rest first edge as the head carries it, and from that edge's velocity; the
  // paper's from the strand's own first edge.
  const Vector3<Real> carried = head.rotation() * rest.edges[0];
  Vector3<Real> edgeStart = carried, velocityStart = head.carriedEdgeVelocityBefore(rest.edges[0]);
  if (isPaper) {
    edgeStart = scratch.edges[0];
    velocityStart = scratch.velocityDifferences[0];
  }
  smooth(scratch.edges, rest.bendSmoothingShare, edgeStart, taps.smoothedEdges);
  smooth(scratch.edges, rest.coreSmoothingShare, edgeStart, taps.coreEdges);
  smooth(scratch.velocityDifferences, rest.coreSmoothingShare, velocityStart,
         scratch.smoothedVelocityDifferences);

  transportFrames(head.rotation(), carried, taps.smoothedEdges, taps.frames);
  const Rotation<Real> rootFrame = head.rotation();
  taps.targets.resize(rest.edgeCount());
  for (std::size_t i = 0; i < rest.edgeCount(); ++i) {
    taps.targets[i] = frameBefore(i, rootFrame, taps.frames) * rest.restTargets[i];
  }
}

/// Elastic forces of stretch and bend, and the core's: all that stays explicit (equations 1, 3, 4).
template <class Real>
void computeForces(const RestStrand<Real>& rest, bool isPaper, StepScratch<Real>& scratch,
                   StrandTaps<Real>& taps) {
  taps.stretchForces.resize(rest.edgeCount());
  taps.bendForces.resize(rest.edgeCount());
  taps.coreForces.resize(rest.edgeCount());
  scratch.edgeForces.resize(rest.edgeCount());
  const Real elongation = coreElongation(taps.coreEdges, rest.coreLength);
  taps.coreScale =
      coreScale(elongation, rest.coreElongationLow, rest.coreElongationHigh, rest.coreRelaxedShare);
  for (std::size_t i = 0; i < rest.edgeCount(); ++i) {
    taps.stretchForces[i] = stretchForce(rest.stretchStiffness[i], scratch.edges[i], scratch.directions[i],
                                         rest.stretchRestLengths[i]);
    taps.bendForces[i] = bendForce(rest.bendStiffness[i], scratch.edges[i], taps.targets[i]);
    scratch.edgeForces[i] = coreForce(rest.coreStiffness[i], taps.coreEdges[i], rest.coreRestLengths[i]);
    // The paper's loops damp by themselves.
    if (!isPaper) {
      scratch.edgeForces[i] +=
          coreDamping(rest.coreDamping[i], scratch.smoothedVelocityDifferences[i], taps.coreEdges[i]);
    }
  }
  if (isPaper) {
    taps.coreForces = scratch.edgeForces;
  } else {
    smoothTransposed(scratch.edgeForces, rest.coreSmoothingShare, taps.coreForces);
  }
  for (Vector3<Real>& force : taps.coreForces) force *= taps.coreScale;
}

/// Sum of the forces on particle i [N]: +f_i of the edge below it, -f_{i-1} of the edge above.
template <class Real>
Vector3<Real> particleForce(const StrandTaps<Real>& taps, std::size_t i) {
  Vector3<Real> force = Vector3<Real>::Zero();
  if (i < taps.stretchForces.size()) force += taps.stretchForces[i] + taps.bendForces[i] + taps.coreForces[i];
  if (i > 0) force -= taps.stretchForces[i - 1] + taps.bendForces[i - 1] + taps.coreForces[i - 1];
  return force;
}

/// (M + T C + T^2 K) v+ = M v + T (f + m g), the strand's own system.
template <class Real>
void assembleSystem(const RestStrand<Real>& rest, const StrandTaps<Real>& taps, const Field<Real>& directions,
                    const Vector3<double>& gravity, double T, FieldView<Real> velocities,
                    StrandSystem& system) {
  system.rootCount = rest.rootCount;
  system.contactWeights.clear();
  system.contactMomenta.clear();
  system.masses.assign(rest.masses.begin(), rest.masses.end());
  system.momenta.resize(rest.particleCount());
  system.across.resize(rest.edgeCount());
  system.along.resize(rest.edgeCount());
  system.directions.resize(rest.edgeCount());
  for (std::size_t i = 0; i < rest.particleCount(); ++i) {
    const double m = system.masses[i];
    system.momenta[i] = m * velocities[i].template cast<double>() +
                        T * (particleForce(taps, i).template cast<double>() + m * gravity);
  }
  for (std::size_t i = 0; i < rest.edgeCount(); ++i) {
    const double stretchStiffness = rest.stretchStiffness[i], stretchDamp = rest.stretchDamping[i];
    const double bendStiffness = rest.bendStiffness[i], bendDamp = rest.bendDamping[i];
    // Bend stiffness holds in all directions (the target is held), its damping across the edge only.
    system.across[i] = T * bendDamp + T * T * bendStiffness;
    system.along[i] = std::max(0.0, T * stretchDamp + T * T * stretchStiffness - T * bendDamp);
    system.directions[i] = directions[i].template cast<double>();
  }
}

/// Along the strand at particle i: between the directions of its two edges, or zero.
template <class Real>
Vector3<Real> tangentAt(const Field<Real>& directions, std::size_t i) {
  Vector3<Real> sum = Vector3<Real>::Zero();
  if (i > 0) sum += directions[i - 1];
  if (i < directions.size()) sum += directions[i];
  return directionOr<Real>(sum, Vector3<Real>::Zero());
}

/// What the air adds to the system, from positions and velocities at the step's start.
template <class Real>
void addAir(const RestStrand<Real>& rest, const AirStep<Real>& air, const Field<Real>& directions, Real T,
            FieldView<Real> positions, FieldView<Real> velocities, StrandSystem& system) {
  system.airWeights.clear();
  system.airMomenta.clear();
  if (!air.settings) return;
  for (std::size_t i = 0; i < rest.particleCount(); ++i) {
    const Vector3<Real> wind =
        air.wind + turbulentWind<Real>(air.modes, air.origin, air.seconds, positions[i]);
    const Vector3<Real> u = velocities[i] - wind;
    const Matrix3<Real> weight =
        airDragMatrix<Real>(*air.settings, u, tangentAt(directions, i), rest.masses[i], T);
    system.airWeights.push_back(weight.template cast<double>());
    system.airMomenta.push_back((weight * wind).template cast<double>());
  }
}

/// Integrator::paper, section 5: the springs' forces of the step's start over dampingLoops x forceLoops small
/// steps. In each, damping from the velocities as they are, then the limit on rates.
template <class Real>
void runPaperLoops(const RestStrand<Real>& rest, const Settings& settings, const HeadStep<Real>& head,
                   StepScratch<Real>& scratch, const StrandTaps<Real>& taps, FieldView<Real> velocities) {
  const Vector3<Real> gravity = toEigen<Real>(settings.gravity);
  const Real maxStretch = static_cast<Real>(settings.maxStretch);
  const Real forceSeconds = head.seconds / static_cast<Real>(settings.forceLoops);
  const Real dampingSeconds = forceSeconds / static_cast<Real>(settings.dampingLoops);
  for (int forceLoop = 0; forceLoop < settings.forceLoops; ++forceLoop) {
    for (std::size_t i = rest.rootCount; i < rest.particleCount(); ++i) {
      velocities[i] += forceSeconds * (particleForce(taps, i) / rest.masses[i] + gravity);
    }
    for (int dampingLoop = 0; dampingLoop < settings.dampingLoops; ++dampingLoop) {
      differences(velocities, scratch.velocityDifferences);
      smooth(scratch.velocityDifferences, rest.coreSmoothingShare, scratch.velocityDifferences[0],
             scratch.smoothedVelocityDifferences);
      for (std::size_t i = 0; i < rest.edgeCount(); ++i) {
        const Vector3<Real>&dv = scratch.velocityDifferences[i], &direction = scratch.directions[i];
        scratch.edgeForces[i] =
            stretchDamping(rest.stretchDamping[i], dv, direction) +
            bendDamping(rest.bendDamping[i], dv, direction) +
            taps.coreScale *
                coreDamping(rest.coreDamping[i], scratch.smoothedVelocityDifferences[i], taps.coreEdges[i]);
      }
      for (std::size_t i = rest.rootCount; i < rest.particleCount(); ++i) {
        Vector3<Real> force = -scratch.edgeForces[i - 1];
        if (i < rest.edgeCount()) force += scratch.edgeForces[i];
        velocities[i] += dampingSeconds / rest.masses[i] * force;
      }
      limitRates(rest.rootCount, maxStretch, head.seconds, rest.edgeLengths, scratch.edges,
                 scratch.directions, velocities);
    }
  }
}

/// All that a step needs before velocities are sought: the new frame of reference, the strand's shape, its
/// forces, the velocities of pinned particles and, but for the paper's loops, the system.
template <class Real>
void prepareStrand(const RestStrand<Real>& rest, const Settings& settings, const HeadStep<Real>& head,
                   const AirStep<Real>& air, FieldView<Real> positions, FieldView<Real> velocities,
                   StepScratch<Real>& scratch, StrandTaps<Real>& taps, StrandSystem& system) {
  const bool isPaper = settings.integrator == Integrator::paper;

  // The head's new translation is the new frame of reference.
  for (Vector3<Real>& v : velocities) v -= head.velocityChange;

  if (rest.edgeCount() > 0) {
    measureShape(rest, isPaper, head, positions, velocities, scratch, taps);
    computeForces(rest, isPaper, scratch, taps);
  }

  if (!isPaper) addAir<Real>(rest, air, scratch.directions, head.seconds, positions, velocities, system);

  // Pinned particles turn with the head; all others follow from forces.
  for (std::size_t i = 0; i < rest.pinnedCount(); ++i) {
    velocities[i] = head.carriedVelocity(rest.points[i]);
  }
  if (!isPaper) {
    assembleSystem(rest, taps, scratch.directions, toEigen<double>(settings.gravity), settings.stepSeconds(),
                   velocities, system);
  }
}

/// The strand's own system with what bodies add to it.
template <class Real>
StrandSystem withPushes(const StrandSystem& system, const std::vector<BodyPush<Real>>& pushes) {
  StrandSystem pushed = system;
  pushed.contactWeights.resize(pushes.size(), Matrix3<double>::Zero());
  pushed.contactMomenta.resize(pushes.size(), Vector3<double>::Zero());
  for (std::size_t i = 0; i < pushes.size(); ++i) {
    pushed.contactWeights[i] += pushes[i].weight;
    pushed.contactMomenta[i] += pushes[i].momentum;
  }
  return pushed;
}

/// Integrator::jacobi: the strand as block; where that would go into a body once more, and again with
/// friction.
template <class Real>
void solveAmongBodies(const RestStrand<Real>& rest, const std::vector<BodyStep<Real>>& bodies,
                      FieldView<Real> positions, const StrandSystem& system, StepScratch<Real>& scratch,
                      FieldView<double> velocities) {
  solveStrand(system, scratch.solve, velocities);
  if (bodies.empty()) return;
  Field<Real> found;
  for (const Vector3<double>& v : velocities) found.push_back(v.template cast<Real>());
  if (!findPushes(rest, bodies, positions, found, scratch.pushes)) return;
  const auto solveAgain = [&] {
    solveStrand(withPushes(system, scratch.pushes), scratch.solve, velocities);
    for (std::size_t i = 0; i < found.size(); ++i) found[i] = velocities[i].template cast<Real>();
  };
  solveAgain();
  addFriction<Real>(rest, scratch.pushes, found);
  solveAgain();
  rub<Real>(rest, scratch.pushes, found);
  for (std::size_t i = 0; i < found.size(); ++i) velocities[i] = found[i].template cast<double>();
}

/// The new velocities of the free particles; the pinned ones are already there.
template <class Real>
void solveVelocities(const RestStrand<Real>& rest, const Settings& settings, const HeadStep<Real>& head,
                     const std::vector<BodyStep<Real>>& bodies, const StrandSystem& system,
                     StepScratch<Real>& scratch, const StrandTaps<Real>& taps, FieldView<Real> positions,
                     FieldView<Real> velocities) {
  if (rest.particleCount() <= rest.rootCount) return;
  if (settings.integrator == Integrator::paper) {
    runPaperLoops(rest, settings, head, scratch, taps, velocities);
    return;
  }
  scratch.solved.resize(velocities.size());
  for (std::size_t i = 0; i < velocities.size(); ++i)
    scratch.solved[i] = velocities[i].template cast<double>();
  if (settings.integrator == Integrator::jacobi) {
    solveAmongBodies<Real>(rest, bodies, positions, system, scratch, scratch.solved);
  }
  if (settings.integrator == Integrator::pointJacobi) {
    iteratePoints(system, settings.pointIterations, settings.chebyshev, scratch.solve, scratch.solved);
  }
  for (std::size_t i = 0; i < velocities.size(); ++i) velocities[i] = scratch.solved[i].template cast<Real>();
}

/// Max |e_i| / l_i over the strand's edges [1].
template <class Real>
Real measureStretch(const RestStrand<Real>& rest, FieldView<Real> positions) {
  Real stretch = 0;
  for (std::size_t i = 0; i < rest.edgeCount(); ++i) {
    stretch = std::max(stretch, (positions[i + 1] - positions[i]).norm() / rest.edgeLengths[i]);
  }
  return stretch;
}

/// Out of bodies, and edges no longer than allowed, in turn: what the one does may undo the other. Velocities
/// do not follow.
template <class Real>
void keepAmongBodies(const RestStrand<Real>& rest, const Settings& settings,
                     const std::vector<BodyStep<Real>>& bodies, StepScratch<Real>& scratch,
                     FieldView<Real> positions, FieldView<Real> velocities) {
  keepOut<Real>(rest, bodies, scratch.starts, positions, velocities);
  for (int round = 1; round < kKeepOutRounds; ++round) {
    differences(positions, scratch.movedEdges);
    Field<Real> unused(positions.size(), Vector3<Real>::Zero());
    const std::size_t limited = limitStretch(rest.rootCount, static_cast<Real>(settings.maxStretch), Real(1),
                                             rest.edgeLengths, scratch.movedEdges, positions, unused);
    if (limited == 0) return;
    keepOut<Real>(rest, bodies, scratch.starts, positions, velocities);
  }
}

/// p += T v with the new velocities, then the stretch limit, then out of bodies.
template <class Real>
void moveStrand(const RestStrand<Real>& rest, const Settings& settings, const HeadStep<Real>& head,
                const std::vector<BodyStep<Real>>& bodies, FieldView<Real> positions,
                FieldView<Real> velocities, StepScratch<Real>& scratch, StrandTaps<Real>& taps) {
  taps.solvedVelocities.assign(velocities.begin(), velocities.end());
  scratch.starts.assign(positions.begin(), positions.end());
  differences(positions, scratch.movedEdges);
  for (std::size_t i = 0; i < rest.edgeCount(); ++i) {
    scratch.movedEdges[i] += head.seconds * (velocities[i + 1] - velocities[i]);
  }

  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (i < rest.rootCount) {
      positions[i] = head.carriedPlace(rest.points[i]);
    } else {
      positions[i] += head.seconds * velocities[i];
    }
  }
  taps.limitedCount = limitStretch(rest.rootCount, static_cast<Real>(settings.maxStretch), head.seconds,
                                   rest.edgeLengths, scratch.movedEdges, positions, velocities);
  if (!bodies.empty()) keepAmongBodies(rest, settings, bodies, scratch, positions, velocities);
  taps.maxEdgeStretch = measureStretch(rest, positions);
  taps.positions.assign(positions.begin(), positions.end());
  taps.velocities.assign(velocities.begin(), velocities.end());
}

}  // namespace ringlet::reference
