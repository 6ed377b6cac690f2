// If strands are divided among devices: packs the rows of contact particles that other devices need. The reference has
// no counterpart: it has all strands.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/part_buffers.glsl"

void put(uint at, uvec3 value) {
  rows[at] = value.x;
  rows[at + 1] = value.y;
  rows[at + 2] = value.z;
}

void main() {
  uint k = gl_GlobalInvocationID.x;
  if (k >= parameters.count) return;
  uint particle = particles[k];
  if (parameters.isStep == 0) {
    put(kFloatsOfSolveRow * k, solved[particle].xyz);
    return;
  }
  uint row = kFloatsOfStepRow * k;
  put(row, positions[particle].xyz);
  put(row + 3, velocities[particle].xyz);
  put(row + 6, solved[particle].xyz);
}
