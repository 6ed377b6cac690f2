// Decides whether this step makes new lists; one invocation, so that the host need not be asked. A list made for
// reach + skin stays valid until two particles may have approached by more than the skin: as long as no particle has
// moved farther than half of it, the motion by its change of velocity included. In dense hair that moves as a whole,
// lists stay valid for longer: there a sample of particles decides (contact_sample, contact_judge.comp), which needs
// the grid.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/contact_buffers.glsl"

uint groupsOf(uint invocations) { return (invocations + gl_WorkGroupSize.x - 1) / gl_WorkGroupSize.x; }

void dispatchGrid(bool grid, bool asks) {
  control.indirectContacts[0] = grid ? groupsOf(parameters.contactCount) : 0;
  control.indirectBuckets[0] = grid ? parameters.bucketCount / kBucketBlock : 0;
  control.indirectOne[0] = grid ? 1 : 0;
  control.indirectSample[0] = asks ? groupsOf(parameters.mostSampled) : 0;
  for (uint axis = 1; axis < 3; ++axis) {
    control.indirectContacts[axis] = 1;
    control.indirectBuckets[axis] = 1;
    control.indirectOne[axis] = 1;
    control.indirectSample[axis] = 1;
    control.indirectQuery[axis] = 1;
    control.indirectMeeting[axis] = 1;
  }
}

void main() {
  if (gl_GlobalInvocationID.x > 0) return;
  control.indirectMeeting[0] = 0;
  control.meetingCount = 0;
  if (control.isHalted != 0) {
    dispatchGrid(false, false);
    control.isDue = 0;
    return;
  }
  bool isGood = control.isListed != 0 && 2.0 * uintBitsToFloat(control.motion) <= parameters.skin;
  bool asks = !isGood && control.isListed != 0 && parameters.sampleStride > 0;
  dispatchGrid(!isGood, asks);
  control.isDue = isGood || asks ? 0 : 1;
  control.sampled = 0;
  control.missed = 0;
  control.step = parameters.step;
  ++control.steps;
  control.parity ^= 1;
  control.liveBlocks = 0;
  control.longestLive = 0;
  if (!isGood) {
    // The largest distance of a pair in these lists, and a margin for the rounding of cells.
    float R = 2.0 * parameters.largestRadius;
    float ahead = 2.0 * parameters.seconds * uintBitsToFloat(control.speed);
    control.cellSize =
        1.01 * (min(max(R + ahead, parameters.reachFactor * R), parameters.listedAhead * R) + parameters.skin);
    control.cellsPerMetre = 1.0 / control.cellSize;
  }
  control.motion = 0;
  control.speed = 0;
}
