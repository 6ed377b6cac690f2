// Checks for a sample of contact particles, another one in each step, whether the lists still contain all
// pairs that touch: counts the pairs found in the grid, and those of them that are not in the particle's
// list. From these counts the last workgroup decides whether new lists are due. The reference has no
// counterpart: it finds all pairs in every step.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/contact_decision.glsl"
#include "shared/contact_search.glsl"
#include "shared/last_group.glsl"

uint found = 0;

bool isSought(vec3 otherPosition, vec3 otherVelocity, uint otherParticle, float r0) {
  ContactMeeting meeting = contactMeeting(x - otherPosition, v - otherVelocity, isBefore(rest.particle, otherParticle));
  return isTouching(meeting, r0, numbers);
}

void take(ContactRest other, float R, float r0) { ++found; }

// Pairs in the list of this particle that touch, as counted by its lanes.
uint listed = 0;

// The lanes of a particle share the rows of cells and the entries of the list.
void lookAt(uint c, uint lane) {
  ContactRest self = contactOf(c);
  int rows = kSearchRows / int(kSampleLanes);
  if (!search(c, positionOf(self.particle), velocityOf(self.particle), groupOf(self.strand), 0.0, int(lane) * rows,
              (int(lane) + 1) * rows))
    control.isHalted = kHaltedByTurns;
  uint list = listOf(c);
  uint count = lists[list];
  uint j = lane;
  if (j < count) do {
    ContactPair pair = pairAt(lists[listedBlock(list, j / kListBlock)] * kListBlock + j % kListBlock);
    if (isSought(positionOf(pair.particle), velocityOf(pair.particle), pair.particle, pair.restLength)) ++listed;
    j += kSampleLanes;
  } while (j < count);
  if (j < count) control.isHalted = kHaltedByTurns;
}

shared uvec2 sharedCounts[kSampleLanes > 1 ? kMostInvocations : 1];

// Call it with all invocations of the workgroup. The lanes of a particle are as far apart as the group has
// particles.
void addLanes(uint lane, uint particles) {
  uint at = gl_LocalInvocationID.x;
  sharedCounts[at] = uvec2(found, listed);
  barrier();
  if (lane > 0) return;
  for (uint other = 1; other < kSampleLanes; ++other) {
    uvec2 counts = sharedCounts[at + other * particles];
    found += counts.x;
    listed += counts.y;
  }
}

void main() {
  readControl();
  uint particles = sampledOfGroup();
  uint lane = gl_LocalInvocationID.x / particles;
  uint c = sampledContact(gl_WorkGroupID.x * particles + gl_LocalInvocationID.x % particles);
  if (c != kNoContact && lane < kSampleLanes) lookAt(c, lane);
  if (kSampleLanes > 1) addLanes(lane, particles);
  if (lane == 0 && found > 0) atomicAdd(control.sampled, found);
  if (lane == 0 && found > listed) atomicAdd(control.missed, found - listed);
  if (isJudgedLater()) return;
  if (isLastGroup() && gl_LocalInvocationID.x == 0) judgeLists();
}
