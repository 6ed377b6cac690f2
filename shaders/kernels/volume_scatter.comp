// Sorts particles of the volume by cell, 5 of 6: puts particles into cells; the order within a cell is arbitrary.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/volume_buffers.glsl"

void main() {
  if (halt.isHalted != 0) return;
  uint i = gl_GlobalInvocationID.x;
  if (i >= parameters.count) return;
  cells[cellEntry(startOf(cellNumber(cellOf(i))) + cellNumber(cellRank(i)))] = i;
}
