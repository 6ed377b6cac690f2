// Adds the surfaces of bodies, as patches, to the boxes of the lights and of the sky. A surface is opaque: it
// counts as many hairs.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/shadow_volume.glsl"
#include "shared/solids.glsl"

const float kHairs = 8.0;

void main() {
  // In this kernel the band is a range of points: the patches, which follow the points that are drawn.
  if (gl_GlobalInvocationID.x >= band.rowCount) return;
  uint i = band.firstRow + gl_GlobalInvocationID.x;
  vec4 at = solidPosition(i);
  vec3 normal = solidNormal(i).xyz;
  vec2 facing = abs(vec2(dot(normal, picture.lightDirection[0].xyz), dot(normal, picture.lightDirection[1].xyz)));
  addAt(at.xyz, kHairs * at.w * facing, kHairs * at.w);
}
