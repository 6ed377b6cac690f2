// Checks for a sample of contact particles, another in each step, whether the lists still hold all pairs that touch:
// counts the pairs that the grid finds and those of them that are not in the particle's list. The last workgroup judges
// by them whether new lists are due. The reference has no counterpart: it finds all pairs in every step.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/contact_decision.glsl"
#include "shared/contact_search.glsl"
#include "shared/last_group.glsl"

uint found = 0;

bool isSought(vec3 otherPosition, vec3 otherVelocity, uint otherParticle, float r0) {
  ContactMeeting meeting = contactMeeting(x - otherPosition, v - otherVelocity, isBefore(rest.particle, otherParticle));
  return isTouching(meeting, r0, parameters);
}

void take(ContactRest other, float R, float r0) { ++found; }

void lookAt(uint c) {
  if (c == kNoContact) return;
  ContactRest self = contactOf(c);
  if (!search(c, positionOf(self.particle), velocityOf(self.particle), groupOf(self.strand), 0.0))
    control.isHalted = kHaltedByTurns;
  uint list = listOf(c);
  uint count = lists[list];
  uint listed = 0;
  uint j = 0;
  if (count > 0) do {
    ContactPair pair = pairAt(lists[listedBlock(list, j / kListBlock)] * kListBlock + j % kListBlock);
    if (isSought(positionOf(pair.particle), velocityOf(pair.particle), pair.particle, pair.restLength)) ++listed;
  } while (++j < count);
  if (j < count) control.isHalted = kHaltedByTurns;
  if (found > 0) atomicAdd(control.sampled, found);
  if (found > listed) atomicAdd(control.missed, found - listed);
}

void main() {
  lookAt(sampledContact(gl_GlobalInvocationID.x));
  if (isJudgedLater()) return;
  if (isLastGroup() && gl_LocalInvocationID.x == 0) judgeLists();
}
