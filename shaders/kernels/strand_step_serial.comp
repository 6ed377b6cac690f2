// The strand kernel, one thread per strand: the same steps as strand_step.comp on the same equations, sweep by sweep
// over buffers. For strands longer than the lanes form holds, for devices without subgroup shuffles, and as its
// independent check. Mirrored by reference/kernels/strand_step.h.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require

#define RINGLET_EXACT_SMOOTHING
#include "shared/strand_buffers.glsl"
#include "equations/bend_spring.glsl"
#include "equations/core_spring.glsl"
#include "equations/eliminate_edge.glsl"
#include "equations/frame.glsl"
#include "equations/chebyshev_weight.glsl"
#include "equations/implicit_edge.glsl"
#include "equations/smoothing.glsl"
#include "equations/stretch_limit.glsl"
#include "equations/stretch_spring.glsl"
#include "equations/velocity_residual.glsl"

// Scratch of particle i and its edge, vec4s; M, z and the others share room, as each integrator needs only its own.
const uint kEdge = 0;         // xyz direction, w length
const uint kForce = 1;        // xyz all elastic forces of the edge
const uint kCore = 2;         // xyz core spring on the smoothed curve, then back on the real edges
const uint kTransfer = 3;     // 3 columns of M: v_{i+1} = M v_i + z                              (jacobi)
const uint kOffset = 6;       // xyz z                                                            (jacobi)
const uint kInverse = 3;      // D⁻¹, two vec4s: diagonal, off-diagonal                           (point_jacobi)
const uint kRightHandSide = 5;  // xyz                                                            (point_jacobi)
const uint kChange = 6;       // xyz change of the velocity in the last iteration                 (point_jacobi)
const uint kKeptRightHandSide = 7;  // xyz, for the residual                                      (jacobi, point_jacobi)
const uint kCoreDirection = 3;  // xyz                                                            (paper)

// Of bodies, see bodies/run_bodies.glsl; and of the air.
const uint kPushWeight = kScratchPerParticle;    // two vec4s: diagonal, off-diagonal; their w: momentum x and y
const uint kPushRest = kPushWeight + 2;          // x momentum z, y target, z friction's weight
const uint kPushNormal = kPushWeight + 3;        // xyz, w weight
const uint kPushBody = kPushWeight + 4;          // xyz velocity, w friction
const uint kStart = kPushWeight + 5;             // xyz where it was before the move
const uint kShift = kPushWeight + 6;             // xyz of the edge that moves it furthest
const uint kDrag = kScratchPerParticle + (kBodies ? kBodyScratch : 0);  // x across, y along; then xyz the wind
const uint kStride = kDrag + (kAir ? kAirScratch : 0);

uint count;  // particles of the strand
vec3 headChange = vec3(0);  // what velocities still lack to be relative to the head as it travels in this step
float maxStretch = 0.0;
uint limitedEdges = 0;
uint degenerateEdges = 0;
float velocityResidual = 0.0;

// With taps the scratch follows them in the same buffer.
#ifdef RINGLET_TAPS
uint slot(uint i, uint field) {
  return kTapCount * parameters.particleCount + (strand.firstParticle + i) * kStride + field;
}
#else
uint slot(uint i, uint field) { return (strand.firstParticle + i) * kStride + field; }
#endif
vec3 scratchOf(uint i, uint field) { return scratch[slot(i, field)].xyz; }
void setScratch(uint i, uint field, vec3 value) { scratch[slot(i, field)] = vec4(value, 0); }

vec3 position(uint i) { return positions[strand.firstParticle + i].xyz; }
vec3 velocity(uint i) { return velocities[strand.firstParticle + i].xyz; }
void setPosition(uint i, vec3 p) { positions[strand.firstParticle + i] = vec4(p, 0); }
void setVelocity(uint i, vec3 v) { velocities[strand.firstParticle + i] = vec4(v, 0); }
// The solve's result: beside the velocities where it is iterated, in their place where it is not.
const bool kKeepsVelocities = kContacts || kBodies;
#ifdef RINGLET_CONTACTS
vec3 solvedVelocity(uint i) { return kKeepsVelocities ? solved[strand.firstParticle + i].xyz : velocity(i); }
void setSolved(uint i, vec3 v) {
  if (kKeepsVelocities) {
    solved[strand.firstParticle + i] = vec4(v, 0);
  } else {
    setVelocity(i, v);
  }
}
#else
vec3 solvedVelocity(uint i) { return velocity(i); }
void setSolved(uint i, vec3 v) { setVelocity(i, v); }
#endif
bool withContacts() { return kContacts && (parameters.phases & kPhaseContacts) != 0; }
ParticleRest restOf(uint i) { return particleRest(strand.firstParticle + i); }
float edgeScale(uint i) { return edgeScaleOf(restOf(i).edgeLength); }
float mass(uint i) { return restOf(i).mass; }
float longestEdge(uint i) { return parameters.maxStretch * restOf(i).edgeLength; }

// What one dispatch of a step hands to the next: the paper's core blend, or Chebyshev's weight. The tip has no edge, so
// its place is free.
void carry(float x) { scratch[slot(count - 1, kEdge)] = vec4(x, 0, 0, 0); }
float loadCarried() { return scratch[slot(count - 1, kEdge)].x; }

bool isPinned(uint i) { return i < parameters.rootCount; }

vec4 measuredEdge(uint i) {
  vec3 e = position(i + 1) - position(i);
  float edgeLength = length(e);
  if (edgeLength <= 1e-15) ++degenerateEdges;
  maxStretch = max(maxStretch, edgeLength / restOf(i).edgeLength);
  return vec4(e / max(edgeLength, 1e-15), edgeLength);
}

// Root to tip: edges, smoothed curves, frames, targets, stretch and bend springs, the core spring on the smoothed
// curve. Returns the blend of the core's constants.
float springSweep(uint step) {
  vec4 frame = rotationAtStart(step);
  vec3 firstEdge = rotate(frame, strand.firstEdge);
  vec3 edgeStart = firstEdge;
  vec3 velocityStart = turningVelocityBefore(step, firstEdge);
  if (kIntegrator == kIntegratorPaper) {
    edgeStart = position(1) - position(0);
    velocityStart = velocity(1) - velocity(0);
  }
  FilterState bendCurve = startFilter(edgeStart, strand.bendBeta);
  FilterState core = startFilter(edgeStart, strand.coreBeta);
  FilterState coreVelocity = startFilter(velocityStart, strand.coreBeta);
  vec3 direction = directionOf(firstEdge);
  float coreLength = 0.0;
  for (uint i = 0; i + 1 < count; ++i) {
    ParticleRest rest = restOf(i);
    vec4 edge = measuredEdge(i);
    float scale = edgeScaleOf(rest.edgeLength);
    vec3 e = position(i + 1) - position(i);
    scratch[slot(i, kEdge)] = edge;
    smoothNext(bendCurve, e, strand.bendBeta);
    smoothNext(core, e, strand.coreBeta);
    smoothNext(coreVelocity, velocity(i + 1) - velocity(i), strand.coreBeta);

    vec3 target = rotate(frame, rest.target);
    vec3 next = directionOf(bendCurve.d);
    frame = turned(smallestTurn(direction, next), frame);
    if (i % 16 == 15) frame = renormalized(frame);
    direction = next;
    vec3 stretch = stretchForce(strand.stretchStiffness * scale, edge.w, rest.stretchRestLength, edge.xyz);
    vec3 bend = bendForce(strand.bendStiffness * scale * (kBendVaries ? rest.bendFactor : 1.0), e, target);
    setScratch(i, kForce, stretch + bend);

    float damping = kIntegrator == kIntegratorPaper ? 0.0 : strand.coreDamping;
    vec3 b = smoothed(core, strand.coreBeta);
    float bLength = length(b);
    vec3 bDirection = b / max(bLength, 1e-15);
    setScratch(i, kCore, coreForce(strand.coreStiffness * scale, damping * scale, bDirection, bLength,
                                   rest.coreEdgeLength, smoothed(coreVelocity, strand.coreBeta)));
    if (kIntegrator == kIntegratorPaper) setScratch(i, kCoreDirection, bDirection);
    coreLength += bLength;
    RINGLET_TAP(kTapSmoothedEdge, i, vec4(smoothed(bendCurve, strand.bendBeta), 0));
    RINGLET_TAP(kTapCoreEdge, i, vec4(b, 0));
    RINGLET_TAP(kTapFrame, i, frame);
    RINGLET_TAP(kTapTarget, i, vec4(target, 0));
    RINGLET_TAP(kTapStretchForce, i, vec4(stretch, 0));
    RINGLET_TAP(kTapBendForce, i, vec4(bend, 0));
  }
  return coreBlend(coreLength / strand.restCoreLength, parameters.coreRelaxedShare, parameters.coreElongationLow,
                   parameters.coreElongationHigh);
}

// Tip to root: the core's forces back on the real edges by the transposed smoothing.
void coreSweep(float coreScale) {
  FilterState state = emptyFilter();
  for (uint i = count - 1; i-- > 0;) {
    vec3 g = scratchOf(i, kCore);
    if (kIntegrator != kIntegratorPaper) {
      smoothNext(state, g, strand.coreBeta);
      g = smoothed(state, strand.coreBeta);
    }
    g *= coreScale;
    RINGLET_TAP(kTapCoreForce, i, vec4(g, 0));
    setScratch(i, kForce, scratchOf(i, kForce) + g);
  }
}

#ifdef RINGLET_SURROUNDINGS
#include "bodies/strand_air.glsl"
#endif

vec3 forceOn(uint i) {
  vec3 force = i + 1 < count ? scratchOf(i, kForce) : vec3(0);
  return i > 0 ? force - scratchOf(i - 1, kForce) : force;
}
vec3 rightHandSide(uint i) {
  float m = mass(i);
  vec3 sum = m * (velocity(i) - headChange) + stepSeconds() * (forceOn(i) + m * pullOn(strand.firstParticle + i));
#ifdef RINGLET_CONTACTS
  if (withContacts()) sum += contactMomentum(strand.firstParticle + i);
#endif
#ifdef RINGLET_SURROUNDINGS
  if (kAir) {
    vec4 drag = scratch[slot(i, kDrag)];
    sum += m * multiply(AirDrag(drag.x, drag.y), tangentAt(i), scratchOf(i, kDrag + 1));
  }
  if (kBodies)
    sum += vec3(scratch[slot(i, kPushWeight)].w, scratch[slot(i, kPushWeight + 1)].w, scratch[slot(i, kPushRest)].x);
#endif
  return sum;
}
// m and what contacts (2 D + g), the air and bodies add to it.
Symmetric massOf(uint i) {
  Symmetric m = symmetricDiagonal(mass(i));
#ifdef RINGLET_SURROUNDINGS
  if (kAir) {
    vec4 drag = scratch[slot(i, kDrag)];
    m = add(m, airDragMatrix(AirDrag(drag.x, drag.y), tangentAt(i), mass(i)));
  }
  if (kBodies) m = add(m, Symmetric(scratchOf(i, kPushWeight), scratchOf(i, kPushWeight + 1)));
#endif
#ifdef RINGLET_CONTACTS
  if (withContacts()) m = add(m, contactMass(strand.firstParticle + i));
#endif
  return m;
}
ImplicitEdge implicitEdgeOf(uint i) {
  float s = edgeScale(i);
  float factor = kBendVaries ? restOf(i).bendFactor : 1.0;
  float bendStiffness = strand.bendStiffness * s * factor;
  float bendDamping = strand.bendDamping * s * sqrt(factor);
  return implicitEdge(scratchOf(i, kEdge), stepSeconds(), strand.stretchStiffness * s, strand.stretchDamping * s,
                      bendStiffness, compensatedBendDamping(bendDamping, bendStiffness, stepSeconds()));
}

void solveStrandBlock(uint step) {
  uint tip = count - 1;
  Symmetric P = massOf(tip);
  vec3 y = rightHandSide(tip);
  for (uint i = tip; i-- > 0;) {
    Elimination eliminated = eliminateEdge(implicitEdgeOf(i), P, y);
    for (uint c = 0; c < 3; ++c) setScratch(i, kTransfer + c, eliminated.transfer[c]);
    setScratch(i, kOffset, eliminated.offset);
    P = add(P, massOf(i));
    y += rightHandSide(i);
  }
  vec3 v = vec3(0);
  for (uint i = 0; i < count; ++i) {
    if (isPinned(i)) {
      v = pinnedVelocity(step, i);
    } else {
      mat3 M = mat3(scratchOf(i - 1, kTransfer), scratchOf(i - 1, kTransfer + 1), scratchOf(i - 1, kTransfer + 2));
      v = M * v + scratchOf(i - 1, kOffset);
    }
    setSolved(i, v);
  }
}

#ifdef RINGLET_SURROUNDINGS
#include "bodies/strand_bodies.glsl"
#endif

void beginPointJacobi(uint step) {
  for (uint i = 0; i < count; ++i) {
    Symmetric D = symmetricDiagonal(mass(i));
    for (uint side = 0; side < 2; ++side) {  // its edge, then the edge before
      if (side == 0 ? i + 1 >= count : i == 0) continue;
      ImplicitEdge edge = implicitEdgeOf(i - side);
      D = addOuter(addDiagonal(D, edge.across), edge.along, edge.direction);
    }
    D = inverse(D);
    setScratch(i, kInverse, D.d);
    setScratch(i, kInverse + 1, D.o);
    setScratch(i, kRightHandSide, rightHandSide(i));
  }
  for (uint i = 0; i < count; ++i) {
    if (isPinned(i)) setVelocity(i, pinnedVelocity(step, i));
    setScratch(i, kChange, vec3(0));
  }
}

void iteratePointJacobi() {
  float omega = loadCarried();
  for (uint iteration = parameters.loopBegin; iteration < parameters.loopEnd; ++iteration) {
    if (parameters.chebyshev != 0 && iteration > 0) {
      omega = chebyshevWeight(iteration, omega, strand.jacobiGap);
    }
    vec3 rootwardNow = vec3(0);
    for (uint i = 0; i < count; ++i) {
      vec3 now = velocity(i);
      vec3 residual = scratchOf(i, kRightHandSide) - mass(i) * now;
      if (i + 1 < count) residual += multiply(implicitEdgeOf(i), velocity(i + 1) - now);
      if (i > 0) residual += multiply(implicitEdgeOf(i - 1), rootwardNow - now);
      vec3 correction = multiply(Symmetric(scratchOf(i, kInverse), scratchOf(i, kInverse + 1)), residual);
      vec3 change = (omega - 1.0) * scratchOf(i, kChange) + omega * correction;
      if (!isPinned(i)) setVelocity(i, now + change);
      setScratch(i, kChange, change);
      rootwardNow = now;
    }
  }
  carry(omega);
}

void loopAsThePaper() {
  float coreScale = loadCarried();
  float dtForce = stepSeconds() / float(parameters.forceLoops);
  float dtDamping = dtForce / float(parameters.dampingLoops);
  for (uint loop = parameters.loopBegin; loop < parameters.loopEnd; ++loop) {
    for (uint i = parameters.rootCount; i < count; ++i) {
      setVelocity(i, velocity(i) + dtForce * (forceOn(i) / mass(i) + pullOn(strand.firstParticle + i)));
    }
    for (uint inner = 0; inner < parameters.dampingLoops; ++inner) {
      vec3 start = velocity(1) - velocity(0);
      FilterState nu = startFilter(start, strand.coreBeta);
      vec3 before = vec3(0);
      vec3 here = velocity(0);
      for (uint i = 0; i < count; ++i) {
        vec3 damping = vec3(0);
        vec3 next = here;
        if (i + 1 < count) {
          next = velocity(i + 1);
          vec3 dv = next - here;
          smoothNext(nu, dv, strand.coreBeta);
          vec3 direction = scratchOf(i, kEdge);
          vec3 core = scratchOf(i, kCoreDirection);
          vec3 stretching = dot(dv, direction) * direction;
          damping = edgeScale(i) * (strand.stretchDamping * stretching + strand.bendDamping * (dv - stretching) +
                                    coreScale * strand.coreDamping * dot(smoothed(nu, strand.coreBeta), core) * core);
        }
        if (!isPinned(i)) setVelocity(i, here + dtDamping / mass(i) * (damping - before));
        before = damping;
        here = next;
      }
      vec3 shift = vec3(0);
      for (uint i = parameters.rootCount; i < count; ++i) {  // edge i - 1, rates before limiting
        vec4 edge = scratch[slot(i - 1, kEdge)];
        vec3 rootwardNow = velocity(i - 1) - shift;
        float fastest = max(0.0, (longestEdge(i - 1) - edge.w) / stepSeconds());
        shift += limitedRateChange(velocity(i) - rootwardNow, edge.xyz, fastest);
        setVelocity(i, velocity(i) + shift);
      }
    }
  }
}

// Over the free particles; the right-hand sides are those kept before the solve.
void measureResidual() {
  float residualSquared = 0.0;
  float scaleSquared = 0.0;
  for (uint i = parameters.rootCount; i < count; ++i) {
    vec3 rhs = scratchOf(i, kKeptRightHandSide);
    vec3 residual = rhs - mass(i) * velocity(i) + multiply(implicitEdgeOf(i - 1), velocity(i - 1) - velocity(i));
    if (i + 1 < count) residual += multiply(implicitEdgeOf(i), velocity(i + 1) - velocity(i));
    residualSquared += dot(residual, residual);
    scaleSquared += residualScaleSquared(rhs, mass(i), stepSeconds());
  }
  velocityResidual = max(velocityResidual, velocityResidualShare(residualSquared, scaleSquared));
}

// Root to tip: p += T v, then the stretch limit with the edges as they are before limiting. The moved edges come from
// edges, not from positions: those are rounded to the hair's size, and shift / T would show it.
void moveAndLimit(uint step) {
  float T = stepSeconds();
  vec3 shift = vec3(0);
  vec3 velocityBefore = vec3(0);
  for (uint i = 0; i < count; ++i) {
    vec3 v = solvedVelocity(i);
    if (kBodies) setScratch(i, kStart, position(i));
    if (isPinned(i)) {
      setPosition(i, pinAt(step + 1, i));
      if (kKeepsVelocities) setVelocity(i, v);
    } else {
      vec4 edge = scratch[slot(i - 1, kEdge)];
      vec3 moved = edge.w * edge.xyz + T * (v - velocityBefore);
      float share = limitedEdgeShare(moved, longestEdge(i - 1));
      if (share < 0.0) ++limitedEdges;
      shift += share * moved;
      setPosition(i, position(i) + T * v + shift);
      setVelocity(i, v + shift / T);
    }
    velocityBefore = v;
  }
#ifdef RINGLET_SURROUNDINGS
  if (kBodies) keepAmongBodies(step);
#endif
}

void storeReport(uint strandIndex) {
  StrandReport report = reports[strandIndex];
  report.nonfiniteParticles = 0;
  report.firstNonfinite = ~0u;
  for (uint i = 0; i < count; ++i) {
    if (isFiniteVec3(position(i)) && isFiniteVec3(velocity(i))) continue;
    if (report.nonfiniteParticles == 0) report.firstNonfinite = i;
    ++report.nonfiniteParticles;
  }
  for (uint i = 0; i + 1 < count; ++i) measuredEdge(i);  // the last step's stretch
  report.maxStretch = max(report.maxStretch, maxStretch);
  report.limitedEdges += limitedEdges;
  report.degenerateEdges += degenerateEdges;
  report.velocityResidual = max(report.velocityResidual, velocityResidual);
  reports[strandIndex] = report;
}

void springs(uint step) {
  // With contacts the last step's velocities are still wanted (contact_motion.comp): taken off in the right-hand side.
  for (uint i = 0; i < count && !kContacts; ++i) setVelocity(i, velocity(i) - headVelocityChange(step));
  float coreScale = springSweep(step);
  coreSweep(coreScale);
  if (kMeasureResidual) {
    for (uint i = 0; i < count; ++i) setScratch(i, kKeptRightHandSide, rightHandSide(i));
  }
  if (kIntegrator == kIntegratorPointJacobi) {
    beginPointJacobi(step);
    carry(1.0);
  }
  if (kIntegrator == kIntegratorPaper) {
    for (uint i = 0; i < min(count, parameters.rootCount); ++i) setVelocity(i, pinnedVelocity(step, i));
    carry(coreScale);
  }
}

void main() {
  uint strandIndex = parameters.strandBegin + gl_GlobalInvocationID.x;
  if (strandIndex >= parameters.strandEnd) return;
#ifdef RINGLET_CONTACTS
  if (kContacts && control.isHalted != 0) return;
#endif
  strandAt = strandIndex;
  strand = strandRest(strandAt);
  count = strand.particleCount;
  for (uint step = parameters.stepBegin; step < parameters.stepEnd; ++step) {
    if (kContacts) headChange = headVelocityChange(step);
    if ((parameters.phases & kPhaseSprings) != 0) springs(step);
    if ((parameters.phases & kPhaseSolve) != 0) {
      if (kIntegrator == kIntegratorJacobi) {
#ifdef RINGLET_SURROUNDINGS
        if (kAir) feelAir(step);
        if (kBodies) solveAmongBodies(step);
#endif
        if (!kBodies) solveStrandBlock(step);
      }
      if (kIntegrator == kIntegratorPointJacobi) iteratePointJacobi();
      if (kIntegrator == kIntegratorPaper) loopAsThePaper();
    }
    if ((parameters.phases & kPhaseMove) == 0) continue;
    if (kMeasureResidual && kIntegrator != kIntegratorPaper && !kContacts && !kBodies && !kAir) measureResidual();
#ifdef RINGLET_TAPS
    for (uint i = 0; i < count; ++i) RINGLET_TAP(kTapVelocity, i, vec4(solvedVelocity(i), 0));
#endif
    moveAndLimit(step);
  }
  if (!kContacts || (parameters.phases & kPhaseMove) != 0) storeReport(strandIndex);
}
