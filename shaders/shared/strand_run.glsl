// The state of the run that a lane of the strand kernel steps, and queries about its particles and edges.
// Included by kernels/strand_step.comp and by each of its fragments. Every loop over a run says
// RINGLET_OVER_RUN. No function takes a whole run: in memory it would be copied, element by element and
// unrolled.
#ifndef RINGLET_STRAND_RUN
#define RINGLET_STRAND_RUN

#include "equations/implicit_edge.glsl"
#include "scan/lanes.glsl"
#include "shared/root_buffers.glsl"
#include "shared/strand_buffers.glsl"

// Particle k of the run and its edge to k + 1.
vec3 p[RUN];  // [m], relative to the carried origin of the groom
vec3 v[RUN];  // [m/s]
// Constants:
const int kSecond = RUN > 1 ? 1 : 0;
uint first;            // index along the strand of the run's particle 0
vec4 restTarget[RUN];  // xyz rest vector, in components along the frame's direction, its normal and their
                       // cross product; w stretch rest length
vec4 restEdge[RUN];    // mass, largest allowed length, core edge length, edge scale
float inverseLength[RUN];  // 1 / the groom's edge length
// Factors of stiffness and damping, if they vary along the strand:
vec2 stretchVariation[RUN];
vec2 bendVariation[RUN];
vec2 coreVariation[RUN];
// At the step's start:
vec3 e[RUN];       // edge
vec3 dv[RUN];      // velocity difference of the edge's ends
vec3 eHat[RUN];    // direction of the edge
float eLength[RUN];
vec3 force[RUN];   // sum of all elastic forces of the edge
float coreScale;   // blend of the core's constants
vec3 vStart[RUN];  // velocities before the solve
#ifdef RINGLET_CONTACTS
bool withContacts = false;  // this solve includes contacts
#endif

// Values for the report:
float maxStretch = 0.0;
uint limitedEdges = 0;
uint degenerateEdges = 0;
float velocityResidual = 0.0;

bool isParticle(int k) { return first + k < strand.particleCount; }
// Fallen hair begins with the particle from which it was cut off. Here that particle is pinned, and the edge
// after it is void. It belongs to another strand, so it is neither read nor written.
bool isCutEdge(int k) { return kFalls && first + k == 0; }
bool isOwn(int k) { return isParticle(k) && !isCutEdge(k); }
bool isEdge(int k) { return first + k + 1 < strand.particleCount && !isCutEdge(k); }
bool isPinned(int k) { return k < int(kMaxRootCount) && first + k < rootCount(); }
bool isFree(int k) { return isParticle(k) && !isPinned(k); }

float edgeLengthOf(int k) { return restEdge[k].y / numbers.maxStretch; }
// Stiffness and damping of stretch and of the core.
vec2 stretchOf(int k) {
  vec2 spring = vec2(strand.stretchStiffness, strand.stretchDamping) * restEdge[k].w;
  return kProfiles ? spring * stretchVariation[k] : spring;
}
vec2 coreOf(int k, float damping) {
  vec2 spring = vec2(strand.coreStiffness, damping) * restEdge[k].w;
  return kProfiles ? spring * coreVariation[k] : spring;
}
float bendStiffnessOf(int k) { return strand.bendStiffness * restEdge[k].w * (kBendVaries ? bendVariation[k].x : 1.0); }
float bendDampingOf(int k) {
  float damping = strand.bendDamping * restEdge[k].w * (kBendVaries ? bendVariation[k].y : 1.0);
  return compensatedBendDamping(damping, bendStiffnessOf(k), stepSeconds());
}

// Acceleration of particle k [m/s^2]; beyond the tip gravity.
vec3 pullOnRun(int k) {
  if (!kForces) return gravity();  // first, so that no branch that depends on a particle is left
  return !isParticle(k) ? gravity() : pullOn(strand.firstParticle + first + k);
}

// The elastic force of the edge that ends at the run's first particle.
vec3 forceFromRootward() {
  vec3 before = fromRootward(force[RUN - 1], 1);  // called by all lanes (scan/lanes.glsl)
  return lane == 0 ? vec3(0) : before;
}

#endif
