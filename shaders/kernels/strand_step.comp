// The strand kernel, lanes x run: all outer steps of a dispatch for one strand; buffers are accessed only at
// its start and end. Model: Iben et al. 2012, sections 3 and 5, with the choices of reference/step.h; it has
// the same stages in the same order. Mirrored by reference/kernels/strand_step.h. Loops test their condition
// after the body (do, or if and do): a driver that masks lanes (lavapipe) runs the body of other loops once
// more than they have turns. Specialized with RUN = particles per lane, the lanes per strand and the
// integrator. With contacts every solve is a dispatch of its own; the last one of a step moves the strand and
// goes on to the next step's first. Compiled for `jacobi` alone; with RINGLET_HEADS, for many heads at once;
// with RINGLET_CONTACTS, contacts; with RINGLET_SURROUNDINGS, contacts, bodies, air, goals and fields; with
// RINGLET_BASELINES, the other integrators; each with the run in registers and, with RINGLET_IN_MEMORY, in
// memory (scan/lanes.glsl).
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require

#ifdef RINGLET_BASELINES
#define RINGLET_EXACT_SMOOTHING
#endif
#include "equations/bend_spring.glsl"
#include "equations/core_spring.glsl"
#include "equations/frame.glsl"
#include "equations/stretch_limit.glsl"
#include "equations/stretch_spring.glsl"
#include "integrators/jacobi.glsl"
#include "integrators/two_way.glsl"
#include "integrators/residual.glsl"
#include "scan/filter_scan.glsl"
#include "scan/frame_scan.glsl"
#include "scan/prefix_sum.glsl"
#include "shared/strand_run.glsl"
#ifdef RINGLET_SURROUNDINGS
#include "bodies/run_air.glsl"
#include "bodies/run_bodies.glsl"
#include "bodies/run_pulls.glsl"
#endif
#ifdef RINGLET_BASELINES
#include "baselines/paper.glsl"
#include "baselines/point_jacobi.glsl"
#endif

vec3 movedEdge[RUN];  // after the move

// The smoothed curves of the present step, from which forces are computed.
vec3 curveForce[RUN];       // core spring on the smoothed curve
vec3 directionBefore[RUN];  // of the frame before the edge; its normal, up to an angle that is the same for
                            // the whole run
vec3 normalBefore[RUN];
vec3 directionAfter;  // of the frame after the run
vec3 normalAfter;

// Direction of the strand's first edge at rest; frames start from it.
vec3 restDirection() { return directionOf(strand.firstEdge); }

// Beyond the tip everything is void: springs are zero (edge scale), and edges have any length. So nothing
// acts back from there, and no stage needs a test for the tip.
void loadStrand() {
  vec3 direction = restDirection();
  vec3 normal = someNormal(direction);
  vec3 binormal = cross(direction, normal);
  RINGLET_OVER_RUN for (int k = 0; k < runEnd; ++k) {
    bool real = isOwn(k);
    uint i = strand.firstParticle + (real ? first + k : 0);
    p[k] = real ? positionAtStart(i) : vec3(0);
    v[k] = real ? velocityAtStart(i) : vec3(0);
    ParticleRest rest = particleRest(i);
    restTarget[k] = vec4(dot(rest.target, direction), dot(rest.target, normal), dot(rest.target, binormal),
                         rest.stretchRestLength);
    bool edge = isEdge(k);
    restEdge[k] = vec4(real ? rest.mass : 1.0, edge ? numbers.maxStretch * rest.edgeLength : 1e30,
                       rest.coreEdgeLength, edge ? edgeScaleOf(rest.edgeLength) : 0.0);
    inverseLength[k] = edge ? 1.0 / rest.edgeLength : 0.0;
    if (kProfiles) {
      EdgeFactors factors = edgeFactors(i);
      stretchVariation[k] = vec2(factors.stiffness.x, factors.damping.x);
      bendVariation[k] = vec2(factors.stiffness.y, factors.damping.y);
      coreVariation[k] = vec2(factors.stiffness.z, factors.damping.z);
    } else if (kBendVaries) {
      bendVariation[k] = vec2(rest.bendFactor, sqrt(rest.bendFactor));
    }
  }
}

// Edges, velocity differences, lengths and directions; an edge without length has direction zero.
void measureEdges() {
  vec3 pNext = fromTipward(p[0], 1);
  vec3 vNext = fromTipward(v[0], 1);
  RINGLET_OVER_RUN for (int k = 0; k < runEnd; ++k) {
    e[k] = (k + 1 < RUN ? p[min(k + 1, RUN - 1)] : pNext) - p[k];
    dv[k] = (k + 1 < RUN ? v[min(k + 1, RUN - 1)] : vNext) - v[k];
    float squared = dot(e[k], e[k]);
    eLength[k] = sqrt(squared);
    eHat[k] = (1.0 / max(eLength[k], 1e-15)) * e[k];
    degenerateEdges += squared <= 1e-30 && isEdge(k) ? 1 : 0;
    maxStretch = max(maxStretch, eLength[k] * inverseLength[k]);
  }
  if (isCutEdge(0)) {  // smoothing begins with the edge after it; a single particle has none
    bool goesOn = isEdge(kSecond);
    e[0] = goesOn ? e[kSecond] : vec3(0);
    dv[0] = goesOn ? dv[kSecond] : vec3(0);
    eHat[0] = goesOn ? eHat[kSecond] : vec3(0);
  }
}

// The smoothed curves: one gives directions and normals of the frames, the other forces of the core spring.
// Two passes: the first finds each lane's end state, the scan carries it, the second starts where the lane
// before ended.
void smoothCurves(vec3 edgeStart, vec3 velocityStart, vec3 rootDirection, vec3 rootNormal) {
  FilterState bendStart = startFilter(edgeStart, strand.bendBeta);
  FilterState coreStart = startFilter(edgeStart, strand.coreBeta);
  FilterState velocityStartState = startFilter(velocityStart, strand.coreBeta);
  FilterState bend = bendStart;
  FilterState core = coreStart;
  FilterState velocity = velocityStartState;
  if (kLanes > 1) {
    if (lane > 0) bend = core = velocity = emptyFilter();
    RINGLET_OVER_RUN for (int k = 0; k < runEnd; ++k) {
      smoothNext(bend, e[k], strand.bendBeta);
      if (!kOneSmoothing) smoothNext(core, e[k], strand.coreBeta);
      smoothNext(velocity, dv[k], strand.coreBeta);
    }
    bend = filterBeforeRun(bend, bendStart, strand.bendBeta);
    if (!kOneSmoothing) core = filterBeforeRun(core, coreStart, strand.coreBeta);
    velocity = filterBeforeRun(velocity, velocityStartState, strand.coreBeta);
  }

  vec3 direction = lane == 0 ? rootDirection : directionOf(bend.d);
  vec3 normal = lane == 0 ? rootNormal : someNormal(direction);
  float share = smoothedShare(strand.coreBeta);
  // `paper` applies damping in its own loop.
  float damping = kIntegrator == kIntegratorPaper ? 0.0 : strand.coreDamping * share;
  float coreLength = 0.0;
  RINGLET_OVER_RUN for (int k = 0; k < runEnd; ++k) {
    smoothNext(bend, e[k], strand.bendBeta);
    if (!kOneSmoothing) smoothNext(core, e[k], strand.coreBeta);
    smoothNext(velocity, dv[k], strand.coreBeta);
    directionBefore[k] = direction;
    normalBefore[k] = normal;
    vec3 next = directionOf(bend.d);
    vec3 b = kOneSmoothing ? bend.d : core.d;
    vec3 bDirection = kOneSmoothing ? next : directionOf(b);
    float bLength = share * dot(b, bDirection);
    vec2 spring = coreOf(k, damping);
    curveForce[k] = coreForce(spring.x, spring.y, bDirection, bLength, restEdge[k].z, velocity.d);
    coreLength += isEdge(k) ? bLength : 0.0;
    if (next == vec3(0)) next = direction;  // no direction: keeps the last one
    normal = carriedNormal(normal, direction, next);
    direction = next;
    if (isEdge(k)) RINGLET_TAP(kTapSmoothedEdge, first + k, vec4(smoothed(bend, strand.bendBeta), 0));
    if (isEdge(k)) RINGLET_TAP(kTapCoreEdge, first + k, vec4(share * b, 0));
  }
  directionAfter = direction;
  normalAfter = normal;
  coreScale = coreBlend(sumOverStrand(coreLength) / strand.restCoreLength, numbers.coreRelaxedShare,
                        numbers.coreElongationLow, numbers.coreElongationHigh);
}

#ifdef RINGLET_TAPS
vec4 frameAfter(int k, vec2 twist) {
  vec3 direction = k + 1 < RUN ? directionBefore[min(k + 1, RUN - 1)] : directionAfter;
  vec3 normal = k + 1 < RUN ? normalBefore[min(k + 1, RUN - 1)] : normalAfter;
  return frameBetween(restDirection(), someNormal(restDirection()), direction,
                      twist.x * normal + twist.y * cross(direction, normal));
}
#endif

// Frames along the smoothed curve, each edge's target in the frame before it, stretch and bend springs.
void shapeForces() {
  vec2 twist = twistOfRun(directionBefore[0], normalBefore[0], normalAfter);
  RINGLET_OVER_RUN for (int k = 0; k < runEnd; ++k) {
    vec3 direction = directionBefore[k];
    vec3 normal = normalBefore[k];
    vec4 rest = restTarget[k];
    vec3 target = rest.x * direction + (twist.x * rest.y - twist.y * rest.z) * normal +
                  (twist.y * rest.y + twist.x * rest.z) * cross(direction, normal);
    vec3 stretch = stretchForce(stretchOf(k).x, eLength[k], rest.w, eHat[k]);
    vec3 bend = bendForce(bendStiffnessOf(k), e[k], target);
    force[k] = stretch + bend;
    if (isEdge(k)) {
      RINGLET_TAP(kTapFrame, first + k, frameAfter(k, twist));
      RINGLET_TAP(kTapTarget, first + k, vec4(target, 0));
      RINGLET_TAP(kTapStretchForce, first + k, vec4(stretch, 0));
      RINGLET_TAP(kTapBendForce, first + k, vec4(bend, 0));
    }
  }
}

// Applies the core's forces to the real edges by the transpose of the smoothing, from the tip, so that they
// are still a gradient ("transposed core"). The paper applies them to the edges unchanged.
void coreForces() {
  bool isTransposed = kIntegrator != kIntegratorPaper;
  float scale = isTransposed ? coreScale * smoothedShare(strand.coreBeta) : coreScale;
  FilterState state = emptyFilter();
  if (isTransposed && kLanes > 1) {
    RINGLET_OVER_RUN for (int k = runEnd - 1; k >= 0; --k) smoothNext(state, curveForce[k], strand.coreBeta);
    state = filterBeyondRun(state, strand.coreBeta);
  }
  RINGLET_OVER_RUN for (int k = runEnd - 1; k >= 0; --k) {
    if (isTransposed) smoothNext(state, curveForce[k], strand.coreBeta);
    vec3 core = scale * (isTransposed ? state.d : curveForce[k]);
    if (isEdge(k)) RINGLET_TAP(kTapCoreForce, first + k, vec4(core, 0));
    force[k] += core;
  }
  if (isCutEdge(0)) force[0] = vec3(0);  // the start of the smoothing is pinned, as a root's edge is
}

#ifdef RINGLET_SURROUNDINGS
// Solves the strand as a block; if it would enter a body, once more with the bodies' pushes, and again with
// friction. One loop, so that the code contains the solve once.
void solveAmongBodies(uint step, vec3 pinned[3]) {
  clearPushes();
  bool pushed = false;
  uint turn = 0;
  do {
    RINGLET_OVER_RUN for (int k = 0; k < runEnd; ++k) v[k] = vStart[k];
    solveStrandBlock(pinned);
    if (turn == 0) pushed = findPushes(step);
    if (turn == 1 && pushed) addFriction();
    if (turn == 2 && pushed) rubRun();
  } while (++turn < (isAnyOfSubgroup(pushed) ? 3 : 1));
}
#endif

void solveVelocities(uint step) {
  vec3 pinned[3];
  [[unroll]] for (int k = 0; k < 3; ++k) {
    pinned[k] = pinnedVelocity(step, k);
  }
  RINGLET_OVER_RUN for (int k = 0; k < runEnd; ++k) vStart[k] = v[k];
#ifdef RINGLET_SURROUNDINGS
  if (kAir) feelAir(step);
  if (kPulls) feelPulls(step);
  if (kBodies) solveAmongBodies(step, pinned);
#endif
  if (kIntegrator == kIntegratorJacobi && !kBodies) {
    if (kFromEnds) {
      solveFromEnds(pinned);
    } else {
      solveStrandBlock(pinned);
    }
  }
#ifdef RINGLET_BASELINES
  if (kIntegrator == kIntegratorPointJacobi) iteratePointJacobi(pinned);
  if (kIntegrator == kIntegratorPaper) loopAsThePaper(pinned);
#endif
  if (kMeasureResidual && kIntegrator != kIntegratorPaper && !kAddsMass) measureResidual();
  RINGLET_OVER_RUN for (int k = 0; k < runEnd; ++k) {
    if (isOwn(k)) RINGLET_TAP(kTapVelocity, first + k, vec4(v[k], 0));
  }
}

// The stretch limit on the moved edges, as a prefix sum along the strand. Returns whether an edge was too
// long; always false without bodies.
bool limitEdges(bool velocitiesFollow, bool isDone) {
  vec3 shiftInRun[RUN];  // of particle k, by the edges of this lane
  vec3 shift = vec3(0);
  uint limited = 0;
  RINGLET_OVER_RUN for (int k = 0; k < runEnd; ++k) {
    float share = isDone || isPinned(k + 1) ? 0.0 : limitedEdgeShare(movedEdge[k], restEdge[k].y);
    limited += share < 0.0 ? 1 : 0;
    shiftInRun[k] = shift;
    shift += share * movedEdge[k];
  }
  vec3 before = sumBeforeRun(shift);
  RINGLET_OVER_RUN for (int k = 0; k < runEnd; ++k) {
    vec3 s = isPinned(k) ? vec3(0) : before + shiftInRun[k];
    p[k] = isDone ? p[k] : p[k] + s;
    if (velocitiesFollow) v[k] += (1.0 / stepSeconds()) * s;
  }
  if (velocitiesFollow) limitedEdges += limited;
  return kBodies && sumOverStrand(limited) > 0;
}

#ifdef RINGLET_SURROUNDINGS
// Alternates between pushing the strand out of bodies and limiting its stretch, since each may undo the
// other. isDone: both hold already.
void keepAmongBodies(uint step, bool isDone) {
  uint round = 1;
  do {
    keepRunOut(step, isDone);
    if (round == kKeepOutRounds) break;
    vec3 pNext = fromTipward(p[0], 1);
    RINGLET_OVER_RUN for (int k = 0; k < runEnd; ++k)
      movedEdge[k] = (k + 1 < RUN ? p[min(k + 1, RUN - 1)] : pNext) - p[k];
    isDone = !limitEdges(false, isDone);
    ++round;
  } while (isAnyOfSubgroup(!isDone));
}
#endif

// p += T v, then the stretch limit, then out of bodies.
void moveAndLimit(uint step) {
  float T = stepSeconds();
#ifdef RINGLET_SURROUNDINGS
  RINGLET_OVER_RUN for (int k = 0; k < runEnd; ++k) pStart[k] = p[k];
#endif
  // Moved edges are computed from edges and not from positions: positions are rounded relative to the hair's
  // extent, which would show in shift / T.
  vec3 vNext = fromTipward(v[0], 1);
  RINGLET_OVER_RUN for (int k = 0; k < runEnd; ++k) {
    p[k] = isPinned(k) ? pinAt(step + 1, min(k, kMaxRootCount - 1)) : p[k] + T * v[k];
    movedEdge[k] = e[k] + T * ((k + 1 < RUN ? v[min(k + 1, RUN - 1)] : vNext) - v[k]);
  }
  bool isLimited = limitEdges(true, false);
#ifdef RINGLET_SURROUNDINGS
  if (kBodies) keepAmongBodies(step, isClear && !isLimited);
#endif
}

// An idle strand has no particles, so its lanes store nothing.
void storeStrand(uint strandIndex, bool idle) {
  uint nonfinite = 0;
  uint firstNonfinite = ~0u;
  RINGLET_OVER_RUN for (int k = runEnd - 1; k >= 0; --k) {
    if (!isOwn(k)) continue;
    uint i = stateAt(strand.firstParticle + first + k);
    positions[i] = vec4(p[k], 0);  // whole records: writing parts of them costs lavapipe more
    velocities[i] = vec4(v[k], 0);
    if (!isFiniteVec3(p[k]) || !isFiniteVec3(v[k])) {
      ++nonfinite;
      firstNonfinite = first + k;
    }
  }
  maxStretch = maxOverStrand(maxStretch);
  limitedEdges = sumOverStrand(limitedEdges);
  degenerateEdges = sumOverStrand(degenerateEdges);
  nonfinite = sumOverStrand(nonfinite);
  firstNonfinite = minOverStrand(firstNonfinite);
  if (lane == 0 && !idle) {
    StrandReport report = reports[reportAt(strandIndex)];
    report.maxStretch = max(report.maxStretch, maxStretch);
    report.limitedEdges += limitedEdges;
    report.degenerateEdges += degenerateEdges;
    report.nonfiniteParticles = nonfinite;
    report.firstNonfinite = firstNonfinite;
    report.velocityResidual = max(report.velocityResidual, velocityResidual);
    reports[reportAt(strandIndex)] = report;
  }
}

#ifdef RINGLET_CONTACTS
void storeSolved() {
  RINGLET_OVER_RUN for (int k = 0; k < runEnd; ++k) {
    if (isOwn(k)) solved[strand.firstParticle + first + k] = vec4(v[k], 0);
  }
}
#endif

// Computes the forces of a step, from positions and velocities at its start.
void computeForces(uint step) {
  RINGLET_OVER_RUN for (int k = 0; k < runEnd; ++k) v[k] -= headVelocityChange(step);
  measureEdges();
  vec3 firstEdge = rotate(rotationAtStart(step), strand.firstEdge);
  vec3 edgeStart = kIntegrator == kIntegratorPaper ? e[0] : firstEdge;
  vec3 velocityStart = kIntegrator == kIntegratorPaper ? dv[0] : turningVelocityBefore(step, firstEdge);
  vec3 direction = directionOf(firstEdge);
  vec3 normal = rotate(rotationAtStart(step), someNormal(restDirection()));
  if (kFalls) {  // frames start along the strand's own first edge
    normal = carriedNormal(normal, direction, eHat[0]);
    direction = eHat[0];
    edgeStart = e[0];
    velocityStart = dv[0];
  }
  smoothCurves(edgeStart, velocityStart, direction, normal);
  shapeForces();
  coreForces();
}

#ifdef RINGLET_CONTACTS
// One solve with contacts; or, after a move, the first solve of the next step, without them.
void solveOnce(uint strandIndex, bool idle) {
  bool moves = (parameters.phases & kPhaseMove) != 0;
  uint step = parameters.stepBegin;
  do {
    withContacts = (parameters.phases & kPhaseContacts) != 0 && step == parameters.stepBegin;
    computeForces(step);
    solveVelocities(step);
    if (!withContacts || !moves || parameters.stepEnd == parameters.stepBegin + 1) storeSolved();
    if (!withContacts || !moves) continue;
    moveAndLimit(step);
    measureEdges();  // the step's stretch, for the report
    storeStrand(strandIndex, idle);
  } while (++step < parameters.stepEnd);
}
#endif

void main() {
#ifdef RINGLET_CONTACTS
  if (kContacts && control.isHalted != 0) return;
#endif
#ifdef RINGLET_IN_MEMORY
  runEnd = RUN + int(parameters.strandEnd >> 31);
#endif
  numbers = numbersOfFrame;
  findLane();
  uint strandIndex = parameters.strandBegin + placeInHead(invocationOfDispatch() / kLanes);
  // No early return: the lanes of an idle strand repeat the last one and store nothing, so that every shuffle is whole.
  bool idle = strandIndex >= parameters.strandEnd;
  strandAt = min(strandIndex, parameters.strandEnd - 1);
  strand = strandRest(strandAt);
  if (idle) strand.particleCount = 0;
  first = lane * RUN;
  loadStrand();

#ifdef RINGLET_CONTACTS
  if (kContacts) {
    solveOnce(strandIndex, idle);
    return;
  }
#endif
  uint step = parameters.stepBegin;
  do {
    computeForces(step);
    solveVelocities(step);
    moveAndLimit(step);
  } while (++step < parameters.stepEnd);
  measureEdges();  // the last step's stretch, for the report
  storeStrand(strandIndex, idle);
}
