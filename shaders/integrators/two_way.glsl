// `jacobi` for one or two lanes, for hair alone or as a volume: the same exact solve. With two lanes it
// starts from both ends of the strand at once, lane 0 from the root and lane 1 from the tip, and they meet at
// the edge between them; with one lane it goes from the root to the tip and back. No lane waits for what lies
// beyond its run, so no transfers and compliances of whole runs are needed: 2/5 of the work of the
// elimination with a star join (integrators/jacobi.glsl). With four lanes, the inner two starting after the
// outer ones, the work done twice would cost as much as the star join. Mirrored by reference/strand_solve.h.
// Included by kernels/strand_step.comp.
//
//   root  o-o-o-o   o-o-o-o  tip
//         lane 0 -> <- lane 1
//
// From the other end, a particle is described by its velocity without further pull, c, and its mobility C,
// its response to a pull:
//   v = c + C f.   Over an edge of compliance A⁻¹ to a particle of mass m and right-hand side r:
//   S = C + A⁻¹,  E = (1 + m S)⁻¹,  C' = E S,  c' = E (c + S r);     back:  f = r + f' - m v'
// All sums are of positive matrices, so stiff edges cost no digits.
#ifndef RINGLET_TWO_WAY
#define RINGLET_TWO_WAY

#include "equations/implicit_edge.glsl"
#include "integrators/jacobi.glsl"
#include "maths/symmetric.glsl"
#include "shared/strand_run.glsl"
#ifdef RINGLET_SURROUNDINGS
#include "bodies/run_pulls.glsl"
#endif

// The terms of a volume, of goals and of fields add a number to the mass, which is a number too.
const bool kAddsMatrix = kContacts && kPairs || kAir || kBodies;
const bool kFromEnds = kLanes <= 2 && !kAddsMatrix && !kBendVaries;

// The terms that the volume adds to particle k of the run: xyz to its right-hand side, w to its mass.
vec4 volumeAddedToRun(int k) {
#ifdef RINGLET_CONTACTS
  if (kVolume && meetsContacts(k)) return volumeAddedTo(strand.firstParticle + first + k);
#endif
  return vec4(0);
}

// The terms of goals and fields, likewise, for particle j if the lane goes from the root, else for k; both
// indices are constants in registers.
vec4 pullAddedToRun(int j, int k) {
#ifdef RINGLET_SURROUNDINGS
  if (kPulls) return lane == 0 ? pulled[j] : pulled[k];
#endif
  return vec4(0);
}

// The term that goals of edges add to the matrix of edge j if the lane goes from the root, else of k.
float goalAddedToEdge(int j, int k) {
#ifdef RINGLET_SURROUNDINGS
  if (kGoals && kGoalShape) return lane == 0 ? goalAcross[j] : goalAcross[k];
#endif
  return 0.0;
}

// A⁻¹ of an edge of this direction and length, with the term of its goal; that of void edges is never used.
Symmetric complianceOf(vec3 direction, float edgeLength, float added) {
  ImplicitEdge one = implicitEdge(direction, stepSeconds(), strand.stretchStiffness, strand.stretchDamping,
      strand.bendStiffness,
                                  compensatedBendDamping(strand.bendDamping, strand.bendStiffness, stepSeconds()));
  float across = one.across + (kGoalShape ? edgeLength * added : 0.0);
  float a = edgeLength / across;
  return addOuter(symmetricDiagonal(a), -a * (one.along / (one.along + across)), direction);
}

// Whether an edge links particle j to the one before it in this lane's direction.
bool isLinked(int j) { return j > 0 && (lane == 0 ? isEdge(j - 1) : isEdge(RUN - 1 - j)); }

// The force across the edge between the lanes, from the mobilities of their last particles; each lane gets
// its own side's.
vec3 forceBetweenLanes(Symmetric C, vec3 c) {
  Symmetric apart = add(C, complianceOf(eHat[RUN - 1], edgeLengthOf(RUN - 1), goalAddedToEdge(RUN - 1, RUN - 1)));
  apart = add(apart, Symmetric(fromTipward(C.d, 1), fromTipward(C.o, 1)));
  vec3 f = multiply(inverse(apart), fromTipward(c, 1) - c);
  if (!isEdge(RUN - 1)) f = vec3(0);
  vec3 reaction = -fromRootward(f, 1);
  return lane == 0 ? f : reaction;
}

void solveFromEnds(vec3 pinned[3]) {
  bool fromRoot = lane == 0;
  // Arrays are in this lane's order.
  float mass[RUN];
  vec3 r[RUN];
  Symmetric C[RUN];
  vec3 c[RUN];
  vec3 forceBefore = forceFromRootward();
  RINGLET_OVER_RUN for (int j = 0; j < runEnd; ++j) {
    int k = RUN - 1 - j;
    vec3 rootSide = rightHandSide(j, v[j], j > 0 ? force[max(j - 1, 0)] : forceBefore);
    vec3 tipSide = rightHandSide(k, v[k], k > 0 ? force[max(k - 1, 0)] : forceBefore);
    vec4 added = volumeAddedToRun(fromRoot ? j : k);
    if (kPulls) added += pullAddedToRun(j, k);
    r[j] = (fromRoot ? rootSide : tipSide) + added.xyz;
    mass[j] = (fromRoot ? restEdge[j].x : restEdge[k].x) + added.w;
    if (j > 0) {
      Symmetric S = add(C[max(j - 1, 0)], complianceOf(fromRoot ? eHat[max(j - 1, 0)] : eHat[k],
                                                       fromRoot ? edgeLengthOf(max(j - 1, 0)) : edgeLengthOf(k),
                                                       goalAddedToEdge(max(j - 1, 0), k)));
      Symmetric E = inverse(addDiagonal(scale(S, mass[j]), 1.0));
      C[j] = multiplyCommuting(E, S);
      c[j] = multiply(E, c[max(j - 1, 0)] + multiply(S, r[j]));
    }
    if (!isLinked(j)) {  // an end of the strand
      C[j] = symmetricDiagonal(1.0 / mass[j]);
      c[j] = r[j] / mass[j];
    }
    if (fromRoot && isPinned(j)) {
      C[j] = symmetricDiagonal(0.0);
      c[j] = pinned[min(j, 2)];
    }
  }

  vec3 f = kLanes == 1 ? vec3(0) : forceBetweenLanes(C[RUN - 1], c[RUN - 1]);
  vec3 solved[RUN];
  RINGLET_OVER_RUN for (int j = runEnd - 1; j >= 0; --j) {
    solved[j] = c[j] + multiply(C[j], f);
    f = isLinked(j) ? r[j] + f - mass[j] * solved[j] : vec3(0);
  }
  RINGLET_OVER_RUN for (int k = 0; k < runEnd; ++k) v[k] = fromRoot ? solved[k] : solved[RUN - 1 - k];
}

#endif
