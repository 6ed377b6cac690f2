// Writes the positions of a chunk's particles to host memory, each to its place in the frame. Floats are
// moved as integers, since a driver may flush those near 0. The reference has no counterpart: its positions
// are in groom order.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "layout/frame.h"
#include "shared/workgroup.glsl"

layout(set = 0, binding = kBindFramePositions) readonly buffer Positions { uvec4 positions[]; };
layout(set = 0, binding = kBindFramePlaces) readonly buffer Places { uint places[]; };
layout(set = 0, binding = kBindFrameOut) writeonly buffer Out { uint frame[]; };
layout(push_constant) uniform Parameters { FrameParameters parameters; };

void main() {
  uint all = gl_NumWorkGroups.x * gl_WorkGroupSize.x;
  for (uint i = gl_GlobalInvocationID.x; i < parameters.count; i += all) {
    uint place = places[i];
    if (place < parameters.begin || place >= parameters.end) continue;
    uvec3 x = positions[i].xyz;
    uint at = 3 * (place - parameters.begin);
    frame[at] = x.x;
    frame[at + 1] = x.y;
    frame[at + 2] = x.z;
  }
}
