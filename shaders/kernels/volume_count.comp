// Sorts particles of the volume by cell, 1 of 4: counts the particles in each cell and gives each a rank in its cell;
// the order of ranks is arbitrary.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/volume_buffers.glsl"

void main() {
  readBox();
  uint i;
  if (!findParticle(i)) return;
  uint cell = cellIndex(cellInBox(placeInCells(placeOf(i))));
  cells[cellOf(i)] = cell;
  cells[cellRank(i)] = atomicAdd(cells[cellCount(cell)], 1);
}
