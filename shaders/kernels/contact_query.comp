// Lists: every contact particle's pairs, from the 27 cells about it, in the order of cells and of contact particles
// inside one. Pairs of strands that may not touch are left out. Where there is no room the frame stops
// (contact_check.comp), and the host makes some.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/contact_search.glsl"

uint list;       // where this invocation's starts
uint count = 0;  // pairs in it
uint block = 0;  // its last

void append(ContactPair pair) {
  if (count % kListBlock == 0) {
    block = atomicAdd(control.blocks, 1);
    if (count / kListBlock < parameters.mostBlocks) lists[listedBlock(list, count / kListBlock)] = block;
  }
  // Without room, what is wanted is still counted.
  if (block < parameters.blockCount) pairs[block * kListBlock + count % kListBlock] = pair;
  ++count;
}

// By place, or by how fast the two near each other.
bool isSought(vec3 otherPosition, vec3 otherVelocity, uint otherParticle, float r0) {
  precise vec3 apart = x - otherPosition;
  precise float squared = apart.x * apart.x + apart.y * apart.y + apart.z * apart.z;
  float ahead = parameters.seconds * length(v - otherVelocity);
  float reach = min(max(r0 + ahead, parameters.reachFactor * r0), parameters.listedAhead * r0) + parameters.skin;
  return squared < reach * reach;
}

void take(ContactRest other, float R, float r0) {
  vec2 constants = contactConstants(0.5 * (rest.mass + other.mass), R, parameters);
  append(ContactPair(other.particle, r0, constants.x, constants.y));
}

void main() {
  uint place = gl_GlobalInvocationID.x;
  if (place >= placedCount()) return;
  uint c = placedVelocity(place).w;
  list = listOf(c);
  if (isElsewhere(contactOf(c).strand)) {
    lists[list] = 0;
    setListed(c, uintBitsToFloat(placedPosition(place).xyz), uintBitsToFloat(placedVelocity(place).xyz));
    return;
  }
  if (!search(place, parameters.skin)) control.isHalted = kHaltedByTurns;
  lists[list] = count;
  if (count > control.longestList) atomicMax(control.longestList, count);
  setListed(c, x, v);
  atomicAdd(control.listed, count);
}
