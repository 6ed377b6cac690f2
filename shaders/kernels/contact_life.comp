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
    if (count / kLiveBlock < numbers.mostLiveBlocks) liveLists[list + 1 + count / kLiveBlock] = block;
  }
  // Without room, entries are still counted, so that the host knows how many are needed.
  if (block < numbers.liveBlockCount) {
    uint entry = block * kLiveBlock + count % kLiveBlock;
    forces[entry] = force;
    lives[lifeEntry(now.parity, entry)] = life;
  }
  ++count;
}

// Advances a contact that touches, or did. before: its life before this step; other: the other particle's
// guessed velocity and radius; otherX, otherV: its place and v^0.
void liveOn(ContactLife before, vec4 other, vec3 otherX, vec3 otherV) {
  float r0 = before.restLength;
  ContactMeeting meeting = contactMeeting(x - otherX, v - otherV, isBefore(rest.particle, before.particle));
  bool touching = isTouching(meeting, r0, numbers);
  vec2 shares = nextLife(sharesOf(before.shares), touching, meeting.distance, r0, numbers);
  if (shares == vec2(0)) return;
  float damping = contactDamping(before.stiffness, rest.radius + other.w, numbers);
  float gap = r0 - meeting.distance;
  ContactWeights weights =
      contactWeights(shares, before.shares != 0.0, touching, gap, before.stiffness, damping, numbers);
  addWeights(terms, weights, meeting.normal, gap, guess + other.xyz);
  append(ContactForce(vec4(meeting.normal, weights.spring), before.particle, weights.damping, gap, 0),
         ContactLife(before.particle, lifeOfShares(shares), r0, before.stiffness));
}

void liveOn(ContactLife before[kAtOnce], uint those) {
  vec4 others[kAtOnce];
  vec3 places[kAtOnce];
  vec3 speeds[kAtOnce];
  for (uint j = 0; j < kAtOnce; ++j) {
    others[j] = guessOf(before[j].particle);
    places[j] = positionOf(before[j].particle);
    speeds[j] = velocityOf(before[j].particle);
  }
  for (uint j = 0; j < kAtOnce; ++j)
    if (j < those) liveOn(before[j], others[j], places[j], speeds[j]);
}

uint listBefore;  // the list of the last step's contacts, and their number
uint countBefore;
ContactLife lifeBefore(uint j) { return lifeAt(lifeEntry(now.parity ^ 1, forceEntry(listBefore, j))); }

uint sought = 0;  // where the last contact was found: both lists have the same order
bool wasCutShort = false;  // the driver ended a loop early

/// Whether the contact with a particle is in the list of the last step.
bool isKnown(uint particle) {
  if (countBefore == 0) return false;
  bool known = false;
  uint looked = 0;
  do {
    uint at[kAtOnce];
    ContactLife some[kAtOnce];
    for (uint j = 0; j < kAtOnce; ++j) {
      at[j] = sought + min(looked + j, countBefore - 1);
      if (at[j] >= countBefore) at[j] -= countBefore;
      some[j] = lifeBefore(at[j]);
    }
    uint found = countBefore;
    for (uint j = 0; j < kAtOnce; ++j)
      if (some[j].particle == particle) found = at[j];
    known = found < countBefore;
    if (known) sought = found + 1;
    looked += kAtOnce;
  } while (looked < countBefore && !known);
  if (!known && looked < countBefore) wasCutShort = true;
  return known;
}

// Each choice is a loop of its own, over the bits for which it is true: a driver that runs invocations in lockstep runs
// an `if` for all of them. Loops test their condition after the body, which saves such a driver one turn.
void main() {
  readControl();
  uint longest = control.longestLive;
  if (now.isHalted || gl_GlobalInvocationID.x >= now.meetingCount) return;
  uint c = lists[meetingPlace(gl_GlobalInvocationID.x)];
  rest = contactOf(c);
  x = positionOf(rest.particle);
  v = velocityOf(rest.particle);
  guess = guessOf(rest.particle).xyz;
  list = liveListOf(c, now.parity);
  listBefore = liveListOf(c, now.parity ^ 1);
  countBefore = liveLists[listBefore];

  // Contacts of the last step.
  uint made = 0;  // turns that the loops made; `wanted` counts the turns they should make
  uint wanted = (countBefore + kAtOnce - 1) / kAtOnce;
  if (countBefore > 0) do {
    uint first = made * kAtOnce;
    ContactLife some[kAtOnce];
    for (uint j = 0; j < kAtOnce; ++j) some[j] = lifeBefore(min(first + j, countBefore - 1));
    liveOn(some, countBefore - first);
  } while (++made * kAtOnce < countBefore);

  // Neighbours that touch (contact_touch.comp) and are not contacts yet.
  uint neighbourList = listOf(c);
  uint blockCount = (lists[neighbourList] + kListBlock - 1) / kListBlock;
  wanted += blockCount;
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
      if (isKnown(pairAt(first + k).particle)) fresh &= ~(1u << k);
    } while (touching != 0);
    wanted += (bitCount(fresh) + kAtOnce - 1) / kAtOnce;
    if (fresh != 0) do {
      ++made;
      uint bit[kAtOnce];
      uint those = takeBits(fresh, bit);
      ContactLife some[kAtOnce];
      for (uint j = 0; j < kAtOnce; ++j) {
        ContactPair pair = pairAt(first + bit[j]);
        some[j] = ContactLife(pair.particle, 0.0, pair.restLength, pair.stiffness);
      }
      liveOn(some, those);
    } while (fresh != 0);
    ++made;
  } while (++b < blockCount);
  liveLists[list] = count;
  if (count > longest) atomicMax(control.longestLive, count);
  if (made != wanted || wasCutShort) control.isHalted = kHaltedByTurns;
  setSystem(rest, terms);
}
