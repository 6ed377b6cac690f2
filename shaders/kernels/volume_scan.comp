// Sorts particles of the volume by cell, 2 of 4: the start of each cell within its block of cells, and of each block.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/volume_buffers.glsl"
#define RINGLET_COUNT(cell) cells[cellCount(cell)]
#define RINGLET_START(cell) cells[cellStart(cell)]
#define RINGLET_SUM(block) cells[cellSum(block)]
#include "scan/bucket_starts.glsl"

void main() {
  uint all;
  setStarts(all);
}
