// The terms that contacts of the distance taper add to each particle's system in the second and later iterations of the
// solve (contact_touch.comp prepares the first), from the positions at the step's start and the velocities of the last
// iterate. A contact has no memory: its spring acts while the pair touches, and its damping fades with the distance. A
// spring that would hold a pair together at the last iterate is removed for the rest of the step. Mirrored by
// reference/kernels/contact_step.h.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/contact_terms.glsl"

ContactRest rest;  // this invocation's contact particle
vec3 x;
vec3 v;
ContactTerms terms = kNoTerms;

/// Adds a contact. Returns whether its spring would hold the pair together, and is removed.
bool add(ContactPair pair, vec3 otherX, vec3 otherV, bool pushes) {
  ContactMeeting meeting = contactMeeting(x - otherX, v - otherV, isBefore(rest.particle, pair.particle));
  bool holds = pushes && !isMet(pair.restLength - meeting.distance, meeting.separation, numbers.seconds);
  addContact(terms, pair, meeting, pushes && !holds, v + otherV);
  return holds;
}

void main() {
  readControl();
  if (now.isHalted || gl_GlobalInvocationID.x >= now.meetingCount) return;
  uint c = lists[meetingPlace(gl_GlobalInvocationID.x)];
  rest = contactOf(c);
  x = positionOf(rest.particle);
  v = velocityOf(rest.particle);

  uint list = listOf(c);
  uint blockCount = (lists[list] + kListBlock - 1) / kListBlock;
  bool isWhole = true;  // the driver ended no loop early
  uint b = 0;
  if (blockCount > 0) do {
    uint first = lists[listedBlock(list, b)] * kListBlock;
    uint bits = lists[pairBits(list, b)];
    uint unmet = 0;
    uint acting = bits & ((1u << kListBlock) - 1);
    if (acting != 0) do {
      uint bit[kAtOnce];
      uint entries[kAtOnce];
      uint those = takeBits(acting, bit);
      for (uint j = 0; j < kAtOnce; ++j) entries[j] = first + bit[j];
      Partners some = partnersAt(entries);
      for (uint j = 0; j < kAtOnce; ++j) {
        if (j >= those) continue;
        bool pushes = (bits >> kListBlock + bit[j] & 1) != 0;
        if (add(some.pair[j], some.x[j], some.v[j], pushes)) unmet |= 1u << kListBlock + bit[j];
      }
    } while (acting != 0);
    if (acting != 0) isWhole = false;
    if (unmet != 0) lists[pairBits(list, b)] = bits & ~unmet;
  } while (++b < blockCount);
  if (!isWhole || b < blockCount) control.isHalted = kHaltedByTurns;
  setSystem(rest, terms);
}
