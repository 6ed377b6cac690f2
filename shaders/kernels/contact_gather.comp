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
  uint list = liveListOf(c, control.parity);
  uint count = liveLists[list];
  for (bool has = count > 0; has; has = false) {  // an if, see contact_life.comp
    ContactRest rest = contactOf(c);
    vec3 v = velocityOf(rest.particle);
    uint entry = 0;
    vec3 momentum = vec3(0);
    vec3 unmetPush = vec3(0);
    Symmetric unmet = symmetricDiagonal(0.0);
    for (uint j = 0; j < count; ++j) {
      entry = nextLive(list, control.parity, j, entry);
      ContactLive live = liveAt(entry);
      vec4 Q = live.matrix;
      vec3 otherVelocity = velocityOf(live.particle);
      if (isUnmet(Q, v - otherVelocity)) {
        unmetPush += Q.w * normalize(Q.xyz);
        unmet = addOuter(unmet, 1.0, Q.xyz);
        lives[entry].matrix = vec4(0);
      } else {
        momentum += contactMultiply(Q, v + otherVelocity);
      }
    }
    ContactSystem system = systems[rest.particle];
    float unit = rest.inverseMassUnit;
    vec3 push = vec3(system.diagonal.w, system.offDiagonal.w, system.momentum.w) - unit * unmetPush;
    systems[rest.particle] =
        ContactSystem(vec4(system.diagonal.xyz - unit * unmet.d, push.x), vec4(system.offDiagonal.xyz - unit * unmet.o, push.y),
                      vec4(push + unit * momentum, push.z));
  }
}
