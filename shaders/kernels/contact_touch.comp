// Finds which listed pairs act on each other and which touch, stored as bits beside the blocks of each list;
// and collects the contact particles that have contacts or had some. Later kernels of the step run for these
// only, since most contact particles have listed neighbours but no contact. With the distance taper, also
// computes the terms that contacts add to the first iteration, from guessed velocities. Mirrored by
// reference/kernels/contact_step.h.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "equations/contact_spring.glsl"
#include "shared/contact_buffers.glsl"

uint particle;  // of this invocation
vec3 x;
vec3 v;

// Functions that depend on the taper: whether the step's lists are complete (checkLists), whether a contact
// particle had contacts in the last step (metBefore), whether it has some now (setMeets), and the terms of
// the first iteration.
#ifdef RINGLET_TAPER_TIME
const uint kMeeting = ~((1u << kListBlock) - 1);  // the bits that mean a contact
bool metBefore(uint c) {
  liveLists[liveListOf(c, now.parity)] = 0;
  return liveLists[liveListOf(c, now.parity ^ 1)] > 0;
}
void setMeets(uint c, bool meets) {}
void beginTerms() {}
void checkLists() {}
void addTerms(ContactPair pair, ContactMeeting meeting, bool touching) {}
void setTerms(ContactRest rest) {}
#else
#include "shared/contact_terms.glsl"
const uint kMeeting = (1u << kListBlock) - 1;
bool metBefore(uint c) { return lists[meetsPlace(c)] != 0; }
void setMeets(uint c, bool meets) { lists[meetsPlace(c)] = uint(meets); }
void checkLists() { endLists(listsHadRoom()); }
ContactTerms terms = kNoTerms;
vec3 guess;
void beginTerms() { guess = guessOf(particle).xyz; }
void addTerms(ContactPair pair, ContactMeeting meeting, bool touching) {
  addContact(terms, pair, meeting, touching, guess + guessOf(pair.particle).xyz);
}
void setTerms(ContactRest rest) { setSystem(rest, terms); }
#endif

// Clears the groups of cells and regions, which the next step sets anew.
void emptyCells(uint c) {
  for (uint bucket = c; bucket < numbers.bucketCount; bucket += numbers.contactCount) {
    grid[cellGroups(bucket)] = 0;
    grid[regionGroups(bucket)] = 0;
  }
}

/// Tests a pair, if there is one. Returns its bits as if it were the first of its block.
uint look(ContactPair pair, vec3 otherX, vec3 otherV, bool isThere) {
  ContactMeeting meeting = contactMeeting(x - otherX, v - otherV, isBefore(particle, pair.particle));
  bool touching = isThere && isTouching(meeting, pair.restLength, numbers);
  bool acts = touching || (isThere && meeting.distance < numbers.breakFactor * pair.restLength);
  if (acts) addTerms(pair, meeting, touching);
  return uint(acts) | uint(touching) << kListBlock;
}

void main() {
  readControl();
  bool hadRoom = listsHadRoom();
  if (now.isHalted) return;
  uint c = gl_GlobalInvocationID.x;
  if (c == 0) checkLists();  // invocations that see it halted already would return for lack of room too
  if (!hadRoom || c >= numbers.contactCount) return;
  if (kInGroups) emptyCells(c);
  ContactRest rest = contactOf(c);
  if (isElsewhere(rest.strand)) return;
  particle = rest.particle;
  x = positionOf(particle);
  v = velocityOf(particle);
  beginTerms();
  uint list = listOf(c);
  uint count = lists[list];
  bool meets = false;
  uint made = 0;
  uint begin = 0;
  if (count > 0) do {
    uint first = lists[listedBlock(list, begin / kListBlock)] * kListBlock;
    uint inBlock = min(count - begin, kListBlock);
    uint bits = 0;
    uint k = 0;
    do {
      uint entries[kAtOnce];
      for (uint j = 0; j < kAtOnce; ++j) entries[j] = first + min(k + j, inBlock - 1);
      Partners some = partnersAt(entries);
      for (uint j = 0; j < kAtOnce; ++j)
        bits |= look(some.pair[j], some.x[j], some.v[j], k + j < inBlock) << k + j;
      k += kAtOnce;
    } while (k < inBlock);
    lists[pairBits(list, begin / kListBlock)] = bits;
    meets = meets || (bits & kMeeting) != 0;
    made += min(k, inBlock);
    begin += kListBlock;
  } while (begin < count);
  if (made != count) control.isHalted = kHaltedByTurns;
  bool met = metBefore(c);
  setMeets(c, meets);
  if (!meets && !met) return;
  setTerms(rest);
  uint i = atomicAdd(control.meetingCount, 1);
  lists[meetingPlace(i)] = c;
  if (i % gl_WorkGroupSize.x == 0) atomicAdd(control.indirectMeeting[0], 1);
}
