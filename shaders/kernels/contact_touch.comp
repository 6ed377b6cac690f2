// Which neighbours touch, as bits beside each list's blocks, and which contact particles have contacts or had some: the
// kernels after this one run for those only, and most only stand near others. Mirrored by
// reference/kernels/contact_step.h.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/contact_buffers.glsl"
#include "equations/contact_spring.glsl"

uint particle;  // this invocation's
vec3 x;
vec3 v;

bool touches(uint other, float restLength) {
  ContactMeeting meeting = contactMeeting(x - positionOf(other), v - velocityOf(other), particle < other);
  return isTouching(meeting, restLength, parameters.seconds, parameters.seenAhead);
}

void main() {
  if (control.isHalted != 0 || !listsHadRoom()) return;
  uint c = gl_GlobalInvocationID.x;
  if (c >= parameters.contactCount) return;
  particle = contactOf(c).particle;
  x = positionOf(particle);
  v = velocityOf(particle);
  uint list = listOf(c);
  uint count = lists[list];
  bool meets = liveLists[liveListOf(c, control.parity ^ 1)] > 0;
  uint made = 0;
  uint begin = 0;
  if (count > 0) do {
    uint first = lists[listedBlock(list, begin / kListBlock)] * kListBlock;
    uint inBlock = min(count - begin, kListBlock);
    uint bits = 0;
    uint k = 0;
    do {
      uvec4 two = twoPairsAt(first + k);
      if (touches(two.x, uintBitsToFloat(two.y))) bits |= 1u << k;
      if (touches(two.z, uintBitsToFloat(two.w))) bits |= 2u << k;
      k += 2;
    } while (k < inBlock);
    if (inBlock < 32) bits &= (1u << inBlock) - 1;
    lists[touchingBits(list, begin / kListBlock)] = bits;
    meets = meets || bits != 0;
    made += inBlock;
    begin += kListBlock;
  } while (begin < count);
  if (made != count) control.isHalted = kHaltedByTurns;
  liveLists[liveListOf(c, control.parity)] = 0;
  if (!meets) return;
  uint i = atomicAdd(control.meetingCount, 1);
  lists[meetingPlace(i)] = c;
  if (i % gl_WorkGroupSize.x == 0) atomicAdd(control.indirectMeeting[0], 1);
}
