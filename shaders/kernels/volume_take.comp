// Where strands are divided among devices: what particles of the volume bring that other devices step goes to where the
// grid looks for it; a step that puts particles into cells takes it there later, and needs the cells that they are in.
// Mirrored by nothing: the reference has all strands.
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
