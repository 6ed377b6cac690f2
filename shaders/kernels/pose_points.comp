// Copies particles of hair that is simulated on this device to where the hair that follows them or the
// renderer needs them; an invocation for each particle. Particles are turned with the head if isTurned is
// set.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "maths/quaternion.glsl"
#include "layout/pose.h"
#include "shared/texels.glsl"

layout(local_size_x_id = kSpecGroupSize) in;

layout(set = 0, binding = kBindPosePositions) readonly buffer Positions { vec4 positions[]; };
layout(set = 0, binding = kBindPosePlaces) readonly buffer Places { PosePlace places[]; };
layout(set = 0, binding = kBindPosePoints) writeonly buffer Points { uvec4 points[]; };
layout(set = 0, binding = kPoseTexels + kBindPosePositions) uniform usamplerBuffer positionTexels;
layout(push_constant) uniform Parameters { PoseParameters parameters; };

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= parameters.count) return;
  vec3 x = kTexels ? vectorAt(positionTexels, i).xyz : positions[i].xyz;
  if (parameters.isTurned != 0) x = rotate(parameters.turn, x);
  PosePlace place = places[i];
  points[place.point] = uvec4(floatBitsToUint(x), place.tag);
}
