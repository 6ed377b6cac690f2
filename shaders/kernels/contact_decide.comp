// Whether this step makes new lists: one invocation, so that no host has to be asked. A list made for reach + skin is
// good while no two particles can have come closer by more than the skin: that is while none has moved, and would be
// moved by its change of velocity, by more than half of it.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/contact_buffers.glsl"

void dispatchRebuild(bool rebuild) {
  uint contactGroups = (parameters.contactCount + gl_WorkGroupSize.x - 1) / gl_WorkGroupSize.x;
  control.indirectContacts[0] = rebuild ? contactGroups : 0;
  control.indirectBuckets[0] = rebuild ? parameters.bucketCount / kBucketBlock : 0;
  control.indirectOne[0] = rebuild ? 1 : 0;
  for (uint axis = 1; axis < 3; ++axis) {
    control.indirectContacts[axis] = 1;
    control.indirectBuckets[axis] = 1;
    control.indirectOne[axis] = 1;
    control.indirectMeeting[axis] = 1;
  }
}

void main() {
  if (gl_GlobalInvocationID.x > 0) return;
  control.indirectMeeting[0] = 0;
  control.meetingCount = 0;
  if (control.isHalted != 0) {
    dispatchRebuild(false);
    return;
  }
  bool isGood = control.isListed != 0 && 2.0 * uintBitsToFloat(control.motion) <= parameters.skin;
  dispatchRebuild(!isGood);
  control.step = parameters.step;
  ++control.steps;
  control.parity ^= 1;
  control.liveBlocks = 0;
  control.longestLive = 0;
  if (!isGood) {
    // The furthest a pair of this list may be apart; a little more, for the rounding of cells.
    float R = 2.0 * parameters.largestRadius;
    float ahead = 2.0 * parameters.seconds * uintBitsToFloat(control.speed);
    control.cellSize = 1.01 * (min(R + ahead, parameters.seenAhead * R) + parameters.skin);
    control.cellsPerMetre = 1.0 / control.cellSize;
    control.isListed = 1;
    control.listed = 0;
    control.blocks = 0;
    control.longestList = 0;
    ++control.rebuilds;
  }
  control.motion = 0;
  control.speed = 0;
}
