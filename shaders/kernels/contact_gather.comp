// Prepares the next iteration of the solve with contacts: pair means of the last one's velocities, sum of Q (v_a + v_b),
// with the weights contact_life.comp has set. Contacts seen ahead that the last iterate does not bring about are taken back,
// on both sides alike. Mirrored by reference/kernels/contact_step.h.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/contact_buffers.glsl"
#include "equations/contact_spring.glsl"
#include "maths/symmetric.glsl"

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
  vec3 unmetPush = vec3(0);
  Symmetric unmet = symmetricDiagonal(0.0);
  bool anyUnmet = false;
  for (uint j = 0; j < count; ++j) {
    entry = nextEntry(list, j, entry);
    vec4 Q = normalAt(entry);
    if (Q == vec4(0)) continue;
    vec3 otherVelocity = velocityOf(pairAt(entry).particle);
    if (isUnmet(Q, v - otherVelocity)) {
      unmetPush += Q.w * normalize(Q.xyz);
      unmet = addOuter(unmet, 1.0, Q.xyz);
      normals[entry] = vec4(0);
      anyUnmet = true;
      continue;
    }
    momentum += contactMultiply(Q, v + otherVelocity);
  }
  float unit = rest.inverseMassUnit;
  if (anyUnmet) {
    systems[rest.particle].diagonal -= vec4(unit * unmet.d, 0);
    systems[rest.particle].offDiagonal -= vec4(unit * unmet.o, 0);
    systems[rest.particle].push -= vec4(unit * unmetPush, 0);
  }
  systems[rest.particle].momentum = systems[rest.particle].push + vec4(unit * momentum, 0);
}
