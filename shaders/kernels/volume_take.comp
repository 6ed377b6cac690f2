// If strands are divided among devices: stores the contributions of particles that other devices step where the grid
// reads them. In a step that sorts particles into cells, volume_order.comp stores them, and this extends the box of
// cells. The reference has no counterpart: it has all strands.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/volume_buffers.glsl"

void main() {
  uint at = parameters.hereCount + gl_GlobalInvocationID.x;
  if (halt.isHalted != 0 || at >= parameters.count) return;
  uint i = here[at];
  if (parameters.isFirst == 0 || control.untilSort > 0)
    parcels[locatedAt(i).w].rate = broughtBy(i);
  else
    reachTo(placeBroughtBy(i));
}
