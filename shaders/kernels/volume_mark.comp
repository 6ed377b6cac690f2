// If strands are divided among devices: marks the cells that hold particles stepped here, in a step that sorts
// particles into cells. The reference has no counterpart: it has all strands.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/volume_buffers.glsl"

void main() {
  uint i;
  if (!findParticleHere(i) || control.indirectParticles[0] == 0) return;
  uint cell = cellIndex(cellInBox(uintBitsToFloat(locatedAt(i).xyz)));
  atomicExchange(cells[cellMark(cell)], control.sorts);
}
