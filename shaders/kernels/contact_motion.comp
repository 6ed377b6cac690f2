// How far contact particles have come since their lists were made, and how fast the fastest is: what decides whether lists
// are still good (contact_decide.comp). Reads positions and v^0; writes the control's motion and speed.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/contact_buffers.glsl"

void main() {
  uint c = gl_GlobalInvocationID.x;
  if (c >= parameters.contactCount) return;
  uint particle = contactOf(c).particle;
  vec3 x = positionOf(particle);
  vec3 v = velocityOf(particle);
  float motion = length(x - listedPosition(c)) + parameters.seconds * length(v - listedVelocity(c));
  float speed = length(v);
  // Numbers that are lost must not pass for small ones.
  if (!(motion < 1e30)) motion = 1e30;
  if (!(speed < 1e30)) speed = 1e30;
  // Of numbers >= 0 the bits compare as the numbers do. Most are no record, and a look is cheaper than an atomic.
  if (floatBitsToUint(motion) > control.motion) atomicMax(control.motion, floatBitsToUint(motion));
  if (floatBitsToUint(speed) > control.speed) atomicMax(control.speed, floatBitsToUint(speed));
}
