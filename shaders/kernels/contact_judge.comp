// Evaluates the sample and, if new lists are due, resets what they are built from; one invocation.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/contact_buffers.glsl"

void main() {
  if (gl_GlobalInvocationID.x > 0) return;
  if (control.missed * kMissedOneIn > control.sampled) control.isDue = 1;
  control.indirectQuery[0] = 0;
  if (control.isHalted != 0 || control.isDue == 0) return;
  control.indirectQuery[0] = (parameters.contactCount + gl_WorkGroupSize.x - 1) / gl_WorkGroupSize.x;
  control.isListed = 1;
  control.listed = 0;
  control.blocks = 0;
  control.longestList = 0;
  ++control.rebuilds;
}
