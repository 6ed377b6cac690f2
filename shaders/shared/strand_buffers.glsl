// The buffers and parameters of the strand_step kernels (layout.h), and the taps, which only a kernel compiled with
// RINGLET_TAPS writes.
#ifndef RINGLET_STRAND_BUFFERS
#define RINGLET_STRAND_BUFFERS

#include "shared/layout.h"

layout(local_size_x_id = 0) in;
layout(constant_id = 2) const uint kIntegrator = kIntegratorJacobi;

layout(set = 0, binding = kBindPositions) buffer Positions { vec4 positions[]; };
layout(set = 0, binding = kBindVelocities) buffer Velocities { vec4 velocities[]; };
layout(set = 0, binding = kBindParticles) readonly buffer Particles { ParticleRest particles[]; };
layout(set = 0, binding = kBindStrands) readonly buffer Strands { StrandRest strands[]; };
layout(set = 0, binding = kBindReports) buffer Reports { StrandReport reports[]; };
layout(set = 0, binding = kBindScratch) buffer Scratch { vec4 scratch[]; };
layout(set = 0, binding = kBindPoses) uniform Poses { StepPose poses[kMaxStepPoses]; };
layout(push_constant) uniform Parameters { StepParameters parameters; };

StrandRest strand;  // this invocation's

float stepSeconds() { return parameters.gravity.w; }

// Poses of outer step `step`: one step before its start, its start, its end.
vec4 rotationBefore(uint step) { return poses[step].rotation; }
vec4 rotationAtStart(uint step) { return poses[step + 1].rotation; }
vec4 rotationAtEnd(uint step) { return poses[step + 2].rotation; }
vec3 headVelocityChange(uint step) { return poses[step + 2].velocityChange.xyz; }

bool isFiniteVec3(vec3 x) { return !(any(isnan(x)) || any(isinf(x))); }

#ifdef RINGLET_TAPS
#define RINGLET_TAP(field, particle, value) \
  scratch[(field) * parameters.particleCount + strand.firstParticle + (particle)] = (value)
#else
#define RINGLET_TAP(field, particle, value)
#endif

#endif
