// Whether the step's lists had room; one invocation. If not, everything stands still until the host has made some. If
// so, the step has looked at all they hold.
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
