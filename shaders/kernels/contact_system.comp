// The terms that contacts of the distance taper add to each particle's system in the second and later iterations of the
// solve (contact_touch.comp prepares the first), from the positions at the step's start and the velocities of the last
// iterate. A contact has no memory: its spring acts while the pair touches, and its damping fades with the distance. A
// spring that would hold a pair together at the last iterate is removed for the rest of the step. Mirrored by
// reference/kernels/contact_step.h.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/contact_terms.glsl"

void main() {
  if (control.isHalted != 0 || gl_GlobalInvocationID.x >= control.meetingCount) return;
  uint c = lists[meetingPlace(gl_GlobalInvocationID.x)];
  ContactRest rest = contactOf(c);
  vec3 x = positionOf(rest.particle);
  vec3 v = velocityOf(rest.particle);
  ContactTerms terms = kNoTerms;

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
      uint k = findLSB(acting);
      acting &= acting - 1;
      ContactPair pair = pairAt(first + k);
      vec3 other = velocityOf(pair.particle);
      ContactMeeting meeting =
          contactMeeting(x - positionOf(pair.particle), v - other, isBefore(rest.particle, pair.particle));
      bool pushes = (bits >> kListBlock + k & 1) != 0;
      if (pushes && !isMet(pair.restLength - meeting.distance, meeting.separation, parameters.seconds)) {
        pushes = false;
        unmet |= 1u << kListBlock + k;
      }
      addContact(terms, pair, meeting, pushes, v + other);
    } while (acting != 0);
    if (acting != 0) isWhole = false;
    if (unmet != 0) lists[pairBits(list, b)] = bits & ~unmet;
  } while (++b < blockCount);
  if (!isWhole || b < blockCount) control.isHalted = kHaltedByTurns;
  setSystem(rest, terms);
}
