// Prepares the next iteration of the solve with contacts: pair means of the last one's velocities,
// sum of Q (v_a + v_b), with the weights contact_life.comp has set. Mirrored by reference/kernels/contact_step.h.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/contact_buffers.glsl"
#include "equations/contact_spring.glsl"

void main() {
  if (control.isHalted != 0) return;
  uint c = gl_GlobalInvocationID.x;
  if (c >= parameters.contactCount) return;
  ContactRest rest = contactOf(c);
  vec3 v = velocityOf(rest.particle);
  uint list = listOf(c, control.parity);
  uint count = lists[list];
  uint entry = 0;
  vec3 momentum = vec3(0);
  for (uint j = 0; j < count; ++j) {
    entry = nextEntry(list, j, entry);
    vec4 Q = normalAt(entry);
    if (Q == vec4(0)) continue;
    momentum += contactMultiply(Q, v + velocityOf(pairAt(entry).particle));
  }
  systems[rest.particle].momentum = systems[rest.particle].push + vec4(rest.inverseMassUnit * momentum, 0);
}
