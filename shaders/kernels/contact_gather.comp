// Prepares the next iteration of the solve with contacts of the time taper: the pair means of the last iterate's
// velocities, sum of Q (v_a + v_b), with the weights that contact_life.comp has set. A spring that would hold a pair
// together at the last iterate is removed, for both particles. Mirrored by reference/kernels/contact_step.h.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/contact_buffers.glsl"
#include "equations/contact_spring.glsl"
#include "maths/symmetric.glsl"

vec3 v;  // of this invocation's particle
vec3 momentum = vec3(0);
vec3 unmetPush = vec3(0);
Symmetric unmet = symmetricDiagonal(0.0);

void add(uint entry, ContactForce force, vec3 otherVelocity) {
  vec3 normal = force.normal.xyz;
  float spring = force.normal.w;
  if (spring > 0.0 && !isMet(force.gap, dot(normal, v - otherVelocity), numbers.seconds)) {
    unmetPush += contactPush(spring, force.gap, numbers.seconds) * normal;
    unmet = addOuter(unmet, spring, normal);
    forces[entry].normal.w = 0.0;
    spring = 0.0;
  }
  momentum += contactMultiply(contactWeights(spring, force.damping, numbers), normal, v + otherVelocity);
}

void main() {
  readControl();
  if (now.isHalted || gl_GlobalInvocationID.x >= now.meetingCount) return;
  uint c = lists[meetingPlace(gl_GlobalInvocationID.x)];
  ContactRest rest = contactOf(c);
  v = velocityOf(rest.particle);
  uint list = liveListOf(c, now.parity);
  uint count = liveLists[list];
  uint first = 0;
  if (count > 0) do {
    uint entries[kAtOnce];
    ContactForce some[kAtOnce];
    vec3 speeds[kAtOnce];
    for (uint j = 0; j < kAtOnce; ++j) {
      entries[j] = forceEntry(list, min(first + j, count - 1));
      some[j] = forceAt(entries[j]);
    }
    for (uint j = 0; j < kAtOnce; ++j) speeds[j] = velocityOf(some[j].particle);
    for (uint j = 0; j < kAtOnce; ++j)
      if (first + j < count) add(entries[j], some[j], speeds[j]);
    first += kAtOnce;
  } while (first < count);
  ContactSystem system = systems[rest.particle];
  float unit = rest.inverseMassUnit;
  vec3 push = vec3(system.diagonal.w, system.offDiagonal.w, system.momentum.w) - unit * unmetPush;
  systems[rest.particle].diagonal = vec4(system.diagonal.xyz - unit * unmet.d, push.x);
  systems[rest.particle].offDiagonal = vec4(system.offDiagonal.xyz - unit * unmet.o, push.y);
  systems[rest.particle].momentum = vec4(push + unit * momentum, push.z);
}
