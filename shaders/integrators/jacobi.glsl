// `jacobi`, with the strand as block: each strand's implicit system is block tridiagonal and solved exactly,
// by elimination from the tip within a lane and a star join across lanes. Included by
// kernels/strand_step.comp.
#ifndef RINGLET_JACOBI
#define RINGLET_JACOBI

#include "equations/eliminate_edge.glsl"
#include "equations/implicit_edge.glsl"
#include "maths/symmetric.glsl"
#include "scan/star_join.glsl"
#include "shared/strand_run.glsl"
#ifdef RINGLET_SURROUNDINGS
#include "bodies/run_air.glsl"
#include "bodies/run_bodies.glsl"
#include "bodies/run_pulls.glsl"
#endif

ImplicitEdge implicitEdgeOf(int k) {
  vec2 stretch = stretchOf(k);
  ImplicitEdge edge = implicitEdge(eHat[k], stepSeconds(), stretch.x, stretch.y, bendStiffnessOf(k), bendDampingOf(k));
#ifdef RINGLET_SURROUNDINGS
  if (kGoals && kGoalShape) edge.across += goalAcross[k];
#endif
  return edge;
}

// M v + T (springs + gravity + external forces) of particle k, from its velocity at the step's start.
vec3 rightHandSide(int k, vec3 velocity, vec3 forceBefore) {
  float m = restEdge[k].x;
  return m * (velocity + stepSeconds() * pullOnRun(k)) + stepSeconds() * (force[k] - forceBefore);
}

// Extra terms of particle k's block. Contacts add 2 D to the matrix and a momentum to the right-hand side, a volume g
// and a momentum; they are loaded where they are used, which saves registers. Air, bodies, goals and fields add theirs
// from the run's state.
#ifdef RINGLET_CONTACTS
bool meetsContacts(int k) { return kContacts && withContacts && isParticle(k); }
#endif
const bool kAddsMass = kContacts || kAir || kBodies || kPulls;
Symmetric massOf(int k) {
  Symmetric mass = symmetricDiagonal(restEdge[k].x);
#ifdef RINGLET_SURROUNDINGS
  if (kAir) mass = add(mass, airDragMatrix(drag[k], tangent[k], restEdge[k].x));
  if (kBodies) mass = add(mass, pushWeight[k]);
  if (kPulls) mass = addDiagonal(mass, pulled[k].w);
#endif
#ifdef RINGLET_CONTACTS
  if (meetsContacts(k)) mass = add(mass, contactMass(strand.firstParticle + first + k));
#endif
  return mass;
}
vec3 addedMomentum(int k) {
  vec3 momentum = vec3(0);
#ifdef RINGLET_CONTACTS
  if (meetsContacts(k)) momentum = contactMomentum(strand.firstParticle + first + k);
#endif
#ifdef RINGLET_SURROUNDINGS
  if (kAir) momentum += restEdge[k].x * multiply(drag[k], tangent[k], wind[k]);
  if (kBodies) momentum += pushMomentum[k];
  if (kPulls) momentum += pulled[k].xyz;
#endif
  return momentum;
}

// The right-hand side without the springs of the boundary edges: their pull is part of f, the force across
// the boundary. If it were included, the free ends on both sides would fly apart and the join would cancel
// that again, which would cost float32 its digits.
vec3 rightHandSideOfRun(int k) {
  vec3 pull = (k + 1 < RUN ? force[k] : vec3(0)) - (k > 0 ? force[max(k - 1, 0)] : vec3(0));
  float m = restEdge[k].x;
  vec3 sum = m * (v[k] + stepSeconds() * pullOnRun(k)) + stepSeconds() * pull;
  if (kAddsMass) sum += addedMomentum(k);
  return sum;
}

// H of the boundary edge: A⁻¹. For a void edge it is any positive value, which is never used.
Symmetric edgeCompliance(ImplicitEdge edge) {
  float across = edge.across > 0.0 ? edge.across : 1.0;
  float a = 1.0 / across;
  return addOuter(symmetricDiagonal(a), -a * edge.along / (edge.along + across), edge.direction);
}

void solveStrandBlock(vec3 pinned[3]) {
  mat3 transfer[RUN];   // of edge k: v_{k+1} = transfer v_k + offset + pull f
  vec3 offset[RUN];
  mat3 pull[RUN];

  LaneSystem system;
  system.P = massOf(RUN - 1);
  system.y = rightHandSideOfRun(RUN - 1);
  system.transfer = mat3(isEdge(RUN - 1) ? 1.0 : 0.0);  // 0: the strand ends here, no pull
  if (kLanes > 1) {
    system.compliance = edgeCompliance(implicitEdgeOf(RUN - 1));
    system.offset = multiply(system.compliance, -stepSeconds() * force[RUN - 1]);
  }

  RINGLET_OVER_RUN for (int k = runEnd - 2; k >= 0; --k) {
    ImplicitEdge edge = implicitEdgeOf(k);
    Elimination step = eliminateEdge(edge, system.P, system.y);
    system.P = kAddsMass ? add(system.P, massOf(k)) : addDiagonal(system.P, restEdge[k].x);
    system.y += rightHandSideOfRun(k);
    if (isPinned(k + 1)) {  // its velocity is given, whatever pulls on it
      step.transfer = mat3(0);
      step.offset = pinned[min(k + 1, 2)];
      step.response = symmetricDiagonal(0.0);
    }
    transfer[k] = step.transfer;
    offset[k] = step.offset;
    if (kLanes > 1) {
      pull[k] = multiply(step.response, transpose(system.transfer));
      system.compliance = add(system.compliance, transposeMultiply(transpose(system.transfer), pull[k]));
      system.offset += system.transfer * step.offset;
      system.transfer = system.transfer * step.transfer;
    }
  }

  vec3 f = vec3(0);
  v[0] = pinned[0];
  if (kLanes > 1) {
    Boundary boundary = joinLanes(system);
    v[0] = velocityFromRoot(system, boundary, pinned[0]);
    f = boundaryForce(system, boundary, v[0]);
  }
  RINGLET_OVER_RUN for (int k = 0; k < runEnd - 1; ++k) {
    v[k + 1] = transfer[k] * v[k] + offset[k];
    if (kLanes > 1) v[k + 1] += pull[k] * f;
  }
}

#endif
