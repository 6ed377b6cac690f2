// What scatteredByHair gives for directions and fibres of the test.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "equations/hair_scattering.glsl"

layout(local_size_x = 64) in;
// Of each: towards the light, towards the eye, absorption and along, about and tilt.
layout(std430, set = 0, binding = 0) readonly buffer Cases { vec4 cases[]; };
layout(std430, set = 0, binding = 1) writeonly buffer Found { vec4 found[]; };

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= uint(found.length())) return;
  vec4 fibre = cases[4 * i + 2];
  vec4 rough = cases[4 * i + 3];
  found[i] = vec4(scatteredByHair(HairFibre(fibre.xyz, fibre.w, rough.x, rough.y), vec3(0, 0, 1), cases[4 * i].xyz,
                                  cases[4 * i + 1].xyz), 0);
}
