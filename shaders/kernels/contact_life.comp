// The contacts of a step with the time taper. Advances the life of each contact by one step, from the positions at the
// step's start and v^0, and sets its weights for the iterations of the solve. The first iteration is prepared here,
// from guessed velocities. Both particles of a contact compute the same numbers, so momentum is conserved. Mirrored by
// reference/kernels/contact_step.h.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/contact_terms.glsl"

ContactRest rest;  // this invocation's contact particle
vec3 x;
vec3 v;
vec3 guess;
uint list;       // where the list of its contacts of this step starts
uint count = 0;  // contacts in it
uint block = 0;  // the last block of it
ContactTerms terms = kNoTerms;

void append(ContactForce force, ContactLife life) {
  if (count % kLiveBlock == 0) {
    block = atomicAdd(control.liveBlocks, 1);
    if (count / kLiveBlock < parameters.mostLiveBlocks) liveLists[list + 1 + count / kLiveBlock] = block;
  }
  // Where there is no room, entries are still counted, so that the host knows how many are needed.
  if (block < parameters.liveBlockCount) {
    uint entry = block * kLiveBlock + count % kLiveBlock;
    forces[entry] = force;
    lives[lifeEntry(control.parity, entry)] = life;
  }
  ++count;
}

// Advances a contact that touches, or did; `before` is its life before this step.
void liveOn(ContactLife before) {
  vec4 other = guessOf(before.particle);
  float r0 = before.restLength;
  ContactMeeting meeting = contactMeeting(x - positionOf(before.particle), v - velocityOf(before.particle),
                                          isBefore(rest.particle, before.particle));
  bool touching = isTouching(meeting, r0, parameters);
  vec2 shares = nextLife(sharesOf(before.shares), touching, meeting.distance, r0, parameters);
  if (shares == vec2(0)) return;
  float damping = contactDamping(before.stiffness, rest.radius + other.w, parameters);
  float gap = r0 - meeting.distance;
  ContactWeights weights =
      contactWeights(shares, before.shares != 0.0, touching, gap, before.stiffness, damping, parameters);
  addWeights(terms, weights, meeting.normal, gap, guess + other.xyz);
  append(ContactForce(vec4(meeting.normal, weights.spring), before.particle, weights.damping, gap, 0),
         ContactLife(before.particle, lifeOfShares(shares), r0, before.stiffness));
}

// Each choice is a loop of its own, over the bits for which it is true: a driver that runs invocations in lockstep runs
// an `if` for all of them. Loops test their condition after the body, which saves such a driver one turn.
void main() {
  if (control.isHalted != 0 || gl_GlobalInvocationID.x >= control.meetingCount) return;
  uint c = lists[meetingPlace(gl_GlobalInvocationID.x)];
  rest = contactOf(c);
  x = positionOf(rest.particle);
  v = velocityOf(rest.particle);
  guess = guessOf(rest.particle).xyz;
  list = liveListOf(c, control.parity);
  uint parityBefore = control.parity ^ 1;
  uint listBefore = liveListOf(c, parityBefore);
  uint countBefore = liveLists[listBefore];

  // Contacts of the last step.
  uint made = 0;  // turns that the loops made; `wanted` counts those they should make
  if (countBefore > 0) do {
    liveOn(lifeAt(lifeEntry(parityBefore, forceEntry(listBefore, made))));
  } while (++made < countBefore);

  // Neighbours that touch (contact_touch.comp) and are no contacts yet.
  uint neighbourList = listOf(c);
  uint blockCount = (lists[neighbourList] + kListBlock - 1) / kListBlock;
  uint wanted = countBefore + blockCount;
  uint sought = 0;  // where the last one was found: both lists have the same order
  uint b = 0;
  if (blockCount > 0) do {
    uint first = lists[listedBlock(neighbourList, b)] * kListBlock;
    uint touching = lists[pairBits(neighbourList, b)] >> kListBlock;
    uint fresh = touching;
    wanted += bitCount(touching);
    if (touching != 0) do {
      uint k = findLSB(touching);
      touching &= touching - 1;
      ++made;
      uint particle = pairAt(first + k).particle;
      bool isKnown = false;
      uint looked = 0;
      if (countBefore > 0) do {
        uint j = sought + looked < countBefore ? sought + looked : sought + looked - countBefore;
        isKnown = isKnown || lifeAt(lifeEntry(parityBefore, forceEntry(listBefore, j))).particle == particle;
        if (isKnown) sought = j + 1;
      } while (++looked < countBefore && !isKnown);
      if (isKnown) fresh &= ~(1u << k);
      if (!isKnown && looked < countBefore) ++wanted;  // the driver ended the loop early
    } while (touching != 0);
    wanted += bitCount(fresh);
    if (fresh != 0) do {
      uint k = findLSB(fresh);
      fresh &= fresh - 1;
      ++made;
      ContactPair pair = pairAt(first + k);
      liveOn(ContactLife(pair.particle, 0.0, pair.restLength, pair.stiffness));
    } while (fresh != 0);
    ++made;
  } while (++b < blockCount);
  liveLists[list] = count;
  if (count > control.longestLive) atomicMax(control.longestLive, count);
  if (made != wanted) control.isHalted = kHaltedByTurns;
  setSystem(rest, terms);
}
