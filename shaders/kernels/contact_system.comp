// What contacts add to each particle's system in the next iteration of the solve: D, push and pair means, from
// positions at the step's start and the velocities of the last iterate, or guessed ones before the first. A contact has
// no memory: its spring acts while the two touch, and its damper fades with their distance. A spring that at the last
// iterate would hold two together is taken back for the rest of the step. Both sides of a contact reckon alike, so
// momentum is kept. Mirrored by reference/kernels/contact_step.h.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/contact_buffers.glsl"
#include "equations/contact_spring.glsl"
#include "maths/symmetric.glsl"

layout(constant_id = 8) const bool kFirst = true;  // iteration of the step

vec3 iterateOf(uint particle) { return kFirst ? guessOf(particle).xyz : velocityOf(particle); }

void main() {
  if (control.isHalted != 0 || gl_GlobalInvocationID.x >= control.meetingCount) return;
  uint c = lists[meetingPlace(gl_GlobalInvocationID.x)];
  ContactRest rest = contactOf(c);
  vec3 x = positionOf(rest.particle);
  vec3 v = iterateOf(rest.particle);
  Symmetric D = symmetricDiagonal(0.0);
  vec3 push = vec3(0);
  vec3 momentum = vec3(0);

  uint list = listOf(c);
  uint blockCount = (lists[list] + kListBlock - 1) / kListBlock;
  uint wanted = blockCount;  // turns of the loops; and how many they made
  uint made = 0;
  uint b = 0;
  if (blockCount > 0) do {
    uint first = lists[listedBlock(list, b)] * kListBlock;
    uint bits = lists[pairBits(list, b)];
    uint unmet = 0;
    uint acting = bits & ((1u << kListBlock) - 1);
    wanted += bitCount(acting);
    if (acting != 0) do {
      uint k = findLSB(acting);
      acting &= acting - 1;
      ++made;
      ContactPair pair = pairAt(first + k);
      vec3 other = iterateOf(pair.particle);
      ContactMeeting meeting = contactMeeting(x - positionOf(pair.particle), v - other, rest.particle < pair.particle);
      float gap = pair.restLength - meeting.distance;
      bool pushes = (bits >> kListBlock + k & 1) != 0;
      if (!kFirst && pushes && !isMet(gap, meeting.separation, parameters.seconds)) {
        pushes = false;
        unmet |= 1u << kListBlock + k;
      }
      float delta = dampingAt(meeting.distance, pair.restLength, parameters.breakFactor);
      ContactWeights weights = ContactWeights(pushes ? parameters.seconds * parameters.seconds * pair.stiffness : 0.0,
          parameters.seconds * pair.damping * delta);
      float tangential = parameters.friction * weights.damping;
      D = addOuter(addDiagonal(D, tangential), weights.spring + weights.damping - tangential, meeting.normal);
      push += contactPush(weights.spring, gap, parameters.seconds) * meeting.normal;
      momentum += contactMultiply(weights, parameters.friction, meeting.normal, v + other);
    } while (acting != 0);
    if (unmet != 0) lists[pairBits(list, b)] = bits & ~unmet;
    ++made;
  } while (++b < blockCount);
  if (made != wanted) control.isHalted = kHaltedByTurns;

  float unit = rest.inverseMassUnit;
  systems[rest.particle].diagonal = vec4(unit * D.d, unit * push.x);
  systems[rest.particle].offDiagonal = vec4(unit * D.o, unit * push.y);
  systems[rest.particle].momentum = vec4(unit * (push + momentum), unit * push.z);
}
