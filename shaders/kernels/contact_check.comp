// Checks that the lists of this step had room; one invocation. If they had not, all contact kernels do nothing until
// the host has enlarged the buffers. If they had, the step has examined every pair in them.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/contact_buffers.glsl"

void main() {
  if (gl_GlobalInvocationID.x > 0) return;
  if (control.isHalted != 0) return;
  bool hadRoom = listsHadRoom() && control.liveBlocks <= parameters.liveBlockCount &&
                 control.longestLive <= parameters.mostLiveBlocks * kLiveBlock;
  if (hadRoom) {
    control.pairTests += control.listed;
  } else {
    control.isHalted = kHaltedForRoom;
  }
}
