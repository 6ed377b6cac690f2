// With the time taper: checks that the lists of this step and the lists of its contacts had room; one
// invocation.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/contact_buffers.glsl"

void main() {
  if (gl_GlobalInvocationID.x > 0) return;
  if (control.isHalted != 0) return;
  endLists(listsHadRoom() && control.liveBlocks <= numbers.liveBlockCount &&
           control.longestLive <= numbers.mostLiveBlocks * kLiveBlock);
}
