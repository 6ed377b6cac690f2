// How far contact particles have come since their lists were made, and how fast the fastest is: what decides whether lists
// are still good (contact_decide.comp). Reads positions and v^0; writes the control's motion and speed.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#include "shared/contact_buffers.glsl"

void main() {
  uint c = gl_GlobalInvocationID.x;
  float motion = 0.0;
  float speed = 0.0;
  if (c < parameters.contactCount) {
    uint particle = contacts[c].particle;
    vec3 x = positions[particle].xyz;
    vec3 v = solved[particle].xyz;
    motion = length(x - places[c].position.xyz) + parameters.seconds * length(v - places[c].velocity.xyz);
    speed = length(v);
    // Numbers that are lost must not pass for small ones.
    if (!(motion < 1e30)) motion = 1e30;
    if (!(speed < 1e30)) speed = 1e30;
  }
  motion = subgroupMax(motion);
  speed = subgroupMax(speed);
  if (subgroupElect()) {  // of numbers >= 0 the bits compare as the numbers do
    atomicMax(control.motion, floatBitsToUint(motion));
    atomicMax(control.speed, floatBitsToUint(speed));
  }
}
