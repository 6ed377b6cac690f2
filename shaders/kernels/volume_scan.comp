// Sorts particles of the volume by cell, 2 of 4: the start of each cell within its block of cells, and of each block.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/volume_buffers.glsl"
#include "scan/bucket_starts.glsl"

uint entriesOf(uint cell) { return cells[cellCount(cell)]; }
void setStart(uint cell, uint start) {
  cells[cellCount(cell)] = 0;
  cells[cellStart(cell)] = start;
}
uint sumOf(uint block) { return atomicOr(cells[cellSum(block)], 0); }
uint exchangeSum(uint block, uint sum) { return atomicExchange(cells[cellSum(block)], sum); }

void main() {
  uint all;
  setStarts(all);
}
