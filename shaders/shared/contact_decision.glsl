// Decides on the device, so that the host need not be asked, whether a step makes new lists. A list made for reach +
// skin stays valid until two particles may have approached by more than the skin: as long as no particle has moved
// farther than half of it, the motion by its change of velocity included. In dense hair that moves as a whole, lists
// stay valid for longer: there a sample of particles decides (contact_sample.comp), which needs the grid. Each function
// is for one invocation, once per step.
#ifndef RINGLET_CONTACT_DECISION
#define RINGLET_CONTACT_DECISION

#include "shared/contact_buffers.glsl"
#include "shared/workgroup.glsl"

uint groupsOf(uint invocations) { return (invocations + gl_WorkGroupSize.x - 1) / gl_WorkGroupSize.x; }

/// Evaluates the sample, if there was one, and resets what new lists are built from if they are due. Atomics read what
/// the same dispatch wrote.
void judgeLists() {
  if (atomicOr(control.missed, 0) * kMissedOneIn > atomicOr(control.sampled, 0)) control.isDue = 1;
  control.indirectQuery[0] = 0;
  if (control.isHalted != 0 || control.isDue == 0) return;
  control.indirectQuery[0] = groupsOf(numbers.contactCount);
  control.isListed = 1;
  control.listed = 0;
  control.blocks = 0;
  control.longestList = 0;
  ++control.rebuilds;
}

// With divided hair, contact_judge.comp evaluates the samples of all parts together later.
bool isJudgedLater() { return kDivided && numbers.sampleStride > 0; }

void dispatchGrid(bool grid, bool asks) {
  control.indirectContacts[0] = grid ? groupsOf(numbers.contactCount) : 0;
  control.indirectBuckets[0] = grid ? numbers.bucketCount / kBucketBlock : 0;
  control.indirectSample[0] = asks ? (numbers.mostSampled + sampledOfGroup() - 1) / sampledOfGroup() : 0;
  for (uint axis = 1; axis < 3; ++axis) {
    control.indirectContacts[axis] = 1;
    control.indirectBuckets[axis] = 1;
    control.indirectSample[axis] = 1;
    control.indirectQuery[axis] = 1;
    control.indirectMeeting[axis] = 1;
  }
}

/// Decides by motion and speed. Without a sample, new lists are started at once.
void decideLists() {
  control.indirectMeeting[0] = 0;
  control.meetingCount = 0;
  control.sampled = 0;
  control.missed = 0;
  if (control.isHalted != 0) {
    dispatchGrid(false, false);
    control.isDue = 0;
    control.indirectQuery[0] = 0;
    return;
  }
  float motion = uintBitsToFloat(atomicExchange(control.motion, 0));
  float speed = uintBitsToFloat(atomicExchange(control.speed, 0));
  bool isGood = control.isListed != 0 && 2.0 * motion <= numbers.skin;
  bool asks = !isGood && control.isListed != 0 && numbers.sampleStride > 0;
  dispatchGrid(!isGood, asks);
  control.isDue = isGood || asks ? 0 : 1;
  control.step = parameters.step;
  ++control.steps;
  control.parity ^= 1;
  control.liveBlocks = 0;
  control.longestLive = 0;
  if (!isGood) {
    // The largest distance of a pair in these lists, with a margin for the rounding of cells.
    float R = 2.0 * numbers.largestRadius;
    float ahead = 2.0 * numbers.seconds * speed;
    control.cellSize =
        1.01 * (min(max(R + ahead, numbers.reachFactor * R), numbers.listedAhead * R) + numbers.skin);
    control.cellsPerMetre = 1.0 / control.cellSize;
  }
  if (!asks && !isJudgedLater()) judgeLists();
}

#endif
