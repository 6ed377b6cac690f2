// Particles of the volume by cell, 1 of 6: how many are in each cell, and each one's rank there, in any order.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/volume_buffers.glsl"

void main() {
  if (halt.isHalted != 0) return;
  uint i = gl_GlobalInvocationID.x;
  if (i >= parameters.count) return;
  uint cell = cellIndex(cellInBox(placeInCells(placeBroughtBy(i))));
  cells[cellOf(i)] = cell;
  cells[cellRank(i)] = atomicAdd(cells[cellCount(cell)], 1);
}
