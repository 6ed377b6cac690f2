// Implements kernels/strand_step.h.
#include "reference/kernels/strand_step.h"

#include <algorithm>

#include "reference/equations/air_drag.h"
#include "reference/equations/bend_spring.h"
#include "reference/equations/body_contact.h"
#include "reference/equations/core_spring.h"
#include "reference/equations/force_field.h"
#include "reference/equations/frame.h"
#include "reference/equations/goal_spring.h"
#include "reference/equations/smoothing.h"
#include "reference/equations/stretch_limit.h"
#include "reference/equations/stretch_spring.h"
#include "reference/equations/turbulence.h"

namespace ringlet::reference {
namespace {

// Edges and smoothed edges, frames and targets: the strand's shape (sections 3.2, 3.2.1, 3.3).
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
  // paper's, and those of what falls, from the strand's own first edge.
  Rotation<Real> rootFrame = head.rotation();
  Vector3<Real> carried = rootFrame * rest.edges[0];
  Vector3<Real> edgeStart = carried, velocityStart = head.carriedEdgeVelocityBefore(rest.edges[0]);
  if (isPaper || rest.falls()) {
    edgeStart = scratch.edges[0];
    velocityStart = scratch.velocityDifferences[0];
  }
  if (rest.falls()) {  // from the rest shape as it was cut the shortest way along that edge
    const Rotation<Real> turn = rest.restTurn.template cast<Real>();
    rootFrame = smallestRotation<Real>(turn * rest.edges[0], edgeStart) * turn;
    carried = edgeStart;
  }
  smooth(scratch.edges, rest.bendSmoothingShare, edgeStart, taps.smoothedEdges);
  smooth(scratch.edges, rest.coreSmoothingShare, edgeStart, taps.coreEdges);
  smooth(scratch.velocityDifferences, rest.coreSmoothingShare, velocityStart,
         scratch.smoothedVelocityDifferences);

  transportFrames(rootFrame, carried, taps.smoothedEdges, taps.frames);
  taps.targets.resize(rest.edgeCount());
  for (std::size_t i = 0; i < rest.edgeCount(); ++i) {
    taps.targets[i] = frameBefore(i, rootFrame, taps.frames) * rest.restTargets[i];
  }
}

// Elastic forces of stretch and bend, and the core's: all that stays explicit (equations 1, 3, 4).
template <class Real>
void computeForces(const RestStrand<Real>& rest, bool isPaper, StepScratch<Real>& scratch,
                   StrandTaps<Real>& taps) {
  taps.stretchForces.resize(rest.edgeCount());
  taps.bendForces.resize(rest.edgeCount());
  taps.coreForces.resize(rest.edgeCount());
  scratch.edgeForces.resize(rest.edgeCount());
  const Real elongation = coreElongation(taps.coreEdges, rest.coreLength);
  taps.coreScale = coreScale(elongation, rest.of(&Material::coreElongationLow),
                             rest.of(&Material::coreElongationHigh), rest.of(&Material::coreRelaxedShare));
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

// What pulls on a kilogram of particle i: gravity, and forces from outside [m/s^2].
template <class Real>
Vector3<double> pullOn(const RestStrand<Real>& rest, const Settings& settings, OutsideForces forces,
                       std::size_t i) {
  const Vector3<double> gravity =
      static_cast<double>(rest.of(&Material::gravityFactor)) * toEigen<double>(settings.gravity);
  return forces.empty() ? gravity : gravity + forces[i];
}

// (M + T C + T^2 K) v+ = M v + T (f + m (g + a)), the strand's own system; a from outside.
template <class Real>
void assembleSystem(const RestStrand<Real>& rest, const Settings& settings, OutsideForces forces,
                    const StrandTaps<Real>& taps, const Field<Real>& directions, FieldView<Real> velocities,
                    StrandSystem& system) {
  const double T = settings.stepSeconds();
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
    system.momenta[i] =
        m * velocities[i].template cast<double>() +
        T * (particleForce(taps, i).template cast<double>() + m * pullOn(rest, settings, forces, i));
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

// Along the strand at particle i: between the directions of its two edges, or zero.
template <class Real>
Vector3<Real> tangentAt(const Field<Real>& directions, std::size_t i) {
  Vector3<Real> sum = Vector3<Real>::Zero();
  if (i > 0) sum += directions[i - 1];
  if (i < directions.size()) sum += directions[i];
  return directionOr<Real>(sum, Vector3<Real>::Zero());
}

// What the air adds to the system, from positions and velocities at the step's start.
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

// What goals of edges add: a spring between two particles, with the mass of the one towards the root.
template <class Real>
void addGoalShape(const RestStrand<Real>& rest, const HeadStep<Real>& head, const GoalStep& goals,
                  FieldView<Real> positions, StrandSystem& system) {
  for (std::size_t i = 0; i < rest.edgeCount(); ++i) {
    const Vector3<double> edge = (positions[i + 1] - positions[i]).template cast<double>();
    const Vector3<double> before = head.now * (goals.before[i + 1] - goals.before[i]);
    const Vector3<double> after = head.next * (goals.after[i + 1] - goals.after[i]);
    const GoalPull<double> pull = goalPull<double>(goals.stiffness[i], goals.damping[i], edge, before, after,
                                                   static_cast<double>(head.seconds));
    const double m = rest.masses[i];
    system.across[i] += m * pull.weight;
    system.momenta[i] -= m * pull.momentum;
    system.momenta[i + 1] += m * pull.momentum;
  }
}

// What goals add to the system, from positions at the step's start.
template <class Real>
void addGoals(const RestStrand<Real>& rest, const HeadStep<Real>& head, const GoalStep& goals,
              FieldView<Real> positions, StrandSystem& system) {
  if (goals.isShape) return addGoalShape(rest, head, goals, positions, system);
  for (std::size_t i = 0; i < goals.before.size(); ++i) {
    const Vector3<double> before = head.originNow + head.now * goals.before[i];
    const Vector3<double> after = head.originNext + head.next * goals.after[i];
    const GoalPull<double> pull =
        goalPull<double>(goals.stiffness[i], goals.damping[i], positions[i].template cast<double>(), before,
                         after, static_cast<double>(head.seconds));
    const double m = system.masses[i];
    system.masses[i] += m * pull.weight;
    system.momenta[i] += m * pull.momentum;
  }
}

// What fields add to the system, from positions at the step's start.
template <class Real>
void addFields(const RestStrand<Real>& rest, const FieldStep& step, double T, FieldView<Real> positions,
               StrandSystem& system) {
  for (const ForceField& field : step.fields) {
    for (std::size_t i = 0; i < positions.size(); ++i) {
      const Vector3<double> x = step.origin + positions[i].template cast<double>();
      const GoalPull<double> pull = fieldPull(field, x, step.travel, T);
      const double m = rest.masses[i];
      system.masses[i] += m * pull.weight;
      system.momenta[i] += m * pull.momentum;
    }
  }
}

// Integrator::paper, section 5: the springs' forces of the step's start over dampingLoops x forceLoops small
// steps. In each, damping from the velocities as they are, then the limit on rates.
template <class Real>
void runPaperLoops(const RestStrand<Real>& rest, const Settings& settings, const HeadStep<Real>& head,
                   OutsideForces forces, StepScratch<Real>& scratch, const StrandTaps<Real>& taps,
                   FieldView<Real> velocities) {
  const Real maxStretch = static_cast<Real>(settings.maxStretch);
  const Real forceSeconds = head.seconds / static_cast<Real>(settings.forceLoops);
  const Real dampingSeconds = forceSeconds / static_cast<Real>(settings.dampingLoops);
  for (int forceLoop = 0; forceLoop < settings.forceLoops; ++forceLoop) {
    for (std::size_t i = rest.rootCount; i < rest.particleCount(); ++i) {
      const Vector3<Real> pull = pullOn(rest, settings, forces, i).template cast<Real>();
      velocities[i] += forceSeconds * (particleForce(taps, i) / rest.masses[i] + pull);
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

// The strand's own system with what bodies add to it.
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

// Max |e_i| / l_i over the strand's edges [1].
template <class Real>
Real measureStretch(const RestStrand<Real>& rest, FieldView<Real> positions) {
  Real stretch = 0;
  for (std::size_t i = 0; i < rest.edgeCount(); ++i) {
    stretch = std::max(stretch, (positions[i + 1] - positions[i]).norm() / rest.edgeLengths[i]);
  }
  return stretch;
}

// Out of bodies, and edges no longer than allowed, in turn: what the one does may undo the other. Velocities
// do not follow.
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

}  // namespace

template <class Real>
Vector3<Real> particleForce(const StrandTaps<Real>& taps, std::size_t i) {
  Vector3<Real> force = Vector3<Real>::Zero();
  if (i < taps.stretchForces.size()) force += taps.stretchForces[i] + taps.bendForces[i] + taps.coreForces[i];
  if (i > 0) force -= taps.stretchForces[i - 1] + taps.bendForces[i - 1] + taps.coreForces[i - 1];
  return force;
}

template <class Real>
void prepareStrand(const RestStrand<Real>& rest, const Settings& settings, const HeadStep<Real>& head,
                   const AirStep<Real>& air, OutsideForces forces, const GoalStep& goals,
                   const FieldStep& fields, FieldView<Real> positions, FieldView<Real> velocities,
                   StepScratch<Real>& scratch, StrandTaps<Real>& taps, StrandSystem& system) {
  const bool isPaper = settings.integrator == Integrator::paper;

  // The head's new translation is the new frame of reference.
  for (Vector3<Real>& v : velocities) v -= rest.of(&Material::inertiaFactor) * head.velocityChange;

  if (rest.edgeCount() > 0) {
    measureShape(rest, isPaper, head, positions, velocities, scratch, taps);
    computeForces(rest, isPaper, scratch, taps);
  } else {
    scratch.directions.clear();
  }

  if (!isPaper) addAir<Real>(rest, air, scratch.directions, head.seconds, positions, velocities, system);

  // Pinned particles turn with the head; all others follow from forces.
  for (std::size_t i = 0; i < rest.pinnedCount(); ++i) {
    velocities[i] = head.carriedVelocity(rest.points[i]);
  }
  if (!isPaper) {
    assembleSystem<Real>(rest, settings, forces, taps, scratch.directions, velocities, system);
    addGoals<Real>(rest, head, goals, positions, system);
    addFields<Real>(rest, fields, settings.stepSeconds(), positions, system);
  }
}

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

template <class Real>
void solveVelocities(const RestStrand<Real>& rest, const Settings& settings, const HeadStep<Real>& head,
                     OutsideForces forces, const std::vector<BodyStep<Real>>& bodies,
                     const StrandSystem& system, StepScratch<Real>& scratch, const StrandTaps<Real>& taps,
                     FieldView<Real> positions, FieldView<Real> velocities) {
  if (rest.particleCount() <= rest.rootCount) return;
  if (settings.integrator == Integrator::paper) {
    runPaperLoops<Real>(rest, settings, head, forces, scratch, taps, velocities);
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

#define RINGLET_INSTANTIATE(Real)                                                                         \
  template Vector3<Real> particleForce(const StrandTaps<Real>& taps, std::size_t i);                      \
  template void prepareStrand(const RestStrand<Real>& rest, const Settings& settings,                     \
                              const HeadStep<Real>& head, const AirStep<Real>& air, OutsideForces forces, \
                              const GoalStep& goals, const FieldStep& fields, FieldView<Real> positions,  \
                              FieldView<Real> velocities, StepScratch<Real>& scratch,                     \
                              StrandTaps<Real>& taps, StrandSystem& system);                              \
  template void solveAmongBodies(const RestStrand<Real>& rest, const std::vector<BodyStep<Real>>& bodies, \
                                 FieldView<Real> positions, const StrandSystem& system,                   \
                                 StepScratch<Real>& scratch, FieldView<double> velocities);               \
  template void solveVelocities(const RestStrand<Real>& rest, const Settings& settings,                   \
                                const HeadStep<Real>& head, OutsideForces forces,                         \
                                const std::vector<BodyStep<Real>>& bodies, const StrandSystem& system,    \
                                StepScratch<Real>& scratch, const StrandTaps<Real>& taps,                 \
                                FieldView<Real> positions, FieldView<Real> velocities);                   \
  template void moveStrand(const RestStrand<Real>& rest, const Settings& settings,                        \
                           const HeadStep<Real>& head, const std::vector<BodyStep<Real>>& bodies,         \
                           FieldView<Real> positions, FieldView<Real> velocities,                         \
                           StepScratch<Real>& scratch, StrandTaps<Real>& taps)
RINGLET_INSTANTIATE(float);
RINGLET_INSTANTIATE(double);
#undef RINGLET_INSTANTIATE

}  // namespace ringlet::reference
