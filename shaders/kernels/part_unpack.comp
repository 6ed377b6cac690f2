// If strands are divided among devices: unpacks the rows of contact particles that other devices step. The reference
// has no counterpart: it has all strands.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/part_buffers.glsl"

uvec3 get(uint at) { return uvec3(rows[at], rows[at + 1], rows[at + 2]); }

void main() {
  uint k = gl_GlobalInvocationID.x;
  if (k >= parameters.count) return;
  uint particle = particles[k];
  if (parameters.isStep == 0) {
    solved[particle].xyz = get(kFloatsOfSolveRow * k);
    return;
  }
  uint row = kFloatsOfStepRow * k;
  positions[particle].xyz = get(row);
  velocities[particle].xyz = get(row + 3);
  solved[particle].xyz = get(row + 6);
}
