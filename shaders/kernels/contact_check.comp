// Whether the lists just made had room; one invocation. If not, everything stands still until the host has made some. If so,
// the step will look at all they hold.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/contact_buffers.glsl"

void main() {
  if (gl_GlobalInvocationID.x > 0) return;
  if (control.isHalted != 0) return;
  if (control.blocks > parameters.blockCount || control.longestList > parameters.mostBlocks * kListBlock) {
    control.isHalted = 1;
    return;
  }
  control.pairTests += control.listed;
}
