// The contacts of a step: every one's life goes on by one step, from positions at its start and from v^0, and its weights are
// set for the solve's iterations; the first of them is prepared here, from guessed velocities. Both sides of a contact reckon
// alike, so momentum is kept. Mirrored by reference/kernels/contact_step.h.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/contact_buffers.glsl"
#include "equations/contact_spring.glsl"
#include "maths/symmetric.glsl"

ContactRest rest;  // this invocation's contact particle
vec3 x;
vec3 v;
vec3 guess;
uint list;       // its contacts of this step
uint count = 0;  // how many
uint block = 0;  // their last
Symmetric D = symmetricDiagonal(0.0);
vec3 push = vec3(0);
vec3 momentum = vec3(0);

ContactMeeting meetingWith(uint particle) {
  return contactMeeting(x - positionOf(particle), v - velocityOf(particle), rest.particle < particle);
}

void append(ContactLive live) {
  if (count % kLiveBlock == 0) {
    block = atomicAdd(control.liveBlocks, 1);
    if (count / kLiveBlock < parameters.mostLiveBlocks) liveLists[list + 1 + count / kLiveBlock] = block;
  }
  // Without room, what is wanted is still counted.
  if (block < parameters.liveBlockCount) lives[liveEntry(control.parity, block, count % kLiveBlock)] = live;
  ++count;
}

// A contact that touches, or did: its shares were `before`.
void liveOn(uint particle, uint contact, float restLength, float before) {
  ContactMeeting meeting = meetingWith(particle);
  bool touching = isTouching(meeting, restLength, parameters.seconds, parameters.seenAhead);
  vec3 changes = vec3(parameters.ramp, parameters.stiffnessRelease, parameters.dampingRelease);
  vec2 shares = nextLife(sharesOf(before), touching, meeting.distance, restLength, changes, parameters.breakFactor);
  if (shares == vec2(0)) return;
  ContactRest other = contactOf(contact);
  float mass = 0.5 * (rest.mass + other.mass);
  float stiffness = parameters.stiffness * mass / (rest.point.w + other.point.w);
  float damping = 2.0 * parameters.dampingRatio * sqrt(stiffness * mass);
  ContactWeights weights = contactWeights(shares, touching, meeting.distance, restLength, stiffness, damping,
                                          parameters.friction, parameters.seconds);
  vec4 Q = contactMatrix(weights, meeting.normal);
  D = addOuter(addDiagonal(D, tangentialOf(Q)), 1.0, Q.xyz);
  push += weights.push * meeting.normal;
  momentum += contactMultiply(Q, guess + guessOf(contact));
  append(ContactLive(Q, particle, contact, restLength, lifeOfShares(shares)));
}

bool isNewAndTouching(uint particle, float restLength) {
  return isTouching(meetingWith(particle), restLength, parameters.seconds, parameters.seenAhead);
}

void main() {
  if (control.isHalted != 0 || !listsHadRoom()) return;
  uint c = gl_GlobalInvocationID.x;
  if (c >= parameters.contactCount) return;
  rest = contactOf(c);
  x = positionOf(rest.particle);
  v = velocityOf(rest.particle);
  guess = guessOf(c);
  list = liveListOf(c, control.parity);
  uint parityBefore = control.parity ^ 1;
  uint listBefore = liveListOf(c, parityBefore);
  uint countBefore = liveLists[listBefore];

  // Contacts of the step before.
  uint entry = 0;
  uint made = 0;  // turns of loops, and how many there should be
  for (uint j = 0; j < countBefore; ++j, ++made) {
    entry = nextLive(listBefore, parityBefore, j, entry);
    ContactLive live = liveAt(entry);
    liveOn(live.particle, live.contact, live.restLength, live.shares);
  }

  // Neighbours that touch, as bits of a block, and then those that did not before: most only stand near.
  uint neighbourList = listOf(c);
  uint neighbourCount = lists[neighbourList];
  uint wanted = countBefore + (neighbourCount + kListBlock - 1) / kListBlock;
  uint sought = 0;  // where the last one was found: lists are in like order
  for (uint begin = 0; begin < neighbourCount; begin += kListBlock, ++made) {
    uint first = lists[neighbourList + 1 + begin / kListBlock] * kListBlock;
    uint inBlock = min(neighbourCount - begin, kListBlock);
    uint touching = 0;
    for (uint k = 0; k < inBlock; k += 2) {
      uvec4 two = twoPairsAt(first + k);
      touching |= isNewAndTouching(two.x, uintBitsToFloat(two.y)) ? 1u << k : 0;
      touching |= isNewAndTouching(two.z, uintBitsToFloat(two.w)) ? 2u << k : 0;
    }
    if (inBlock < 32) touching &= (1u << inBlock) - 1;
    wanted += bitCount(touching);
    for (; touching != 0; touching &= touching - 1, ++made) {
      uint at = first + findLSB(touching);
      uvec4 two = twoPairsAt(at & ~1u);
      uvec2 pair = (at & 1) == 0 ? two.xy : two.zw;
      bool isOld = false;
      uint looked = 0;
      for (; looked < countBefore && !isOld; ++looked) {
        uint j = sought + looked < countBefore ? sought + looked : sought + looked - countBefore;
        uint place = liveEntry(parityBefore, liveLists[listBefore + 1 + j / kLiveBlock], j % kLiveBlock);
        isOld = (kTexels ? recordAt(liveTexels, 2 * place + 1).x : lives[place].particle) == pair.x;
        if (isOld) sought = j + 1;
      }
      if (!isOld) {
        if (looked < countBefore) ++wanted;  // the loop was cut short
        liveOn(pair.x, contactAt(pair.x), uintBitsToFloat(pair.y), 0.0);
      }
    }
  }
  liveLists[list] = count;
  if (count > control.longestLive) atomicMax(control.longestLive, count);
  if (made != wanted) control.isHalted = kHaltedByTurns;

  // What was nothing and is nothing needs no telling. (A loop, for an if is run all the same by a driver that runs
  // invocations in step.)
  float unit = rest.inverseMassUnit;
  for (bool tell = count > 0 || countBefore > 0; tell; tell = false) {
    systems[rest.particle] = ContactSystem(vec4(unit * D.d, unit * push.x), vec4(unit * D.o, unit * push.y),
                                           vec4(unit * (push + momentum), unit * push.z));
  }
}
