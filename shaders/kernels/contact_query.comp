// Makes the lists: the pairs of each contact particle, from the 27 cells around it, in the order of cells
// and, within a cell, of contact particles. Pairs of strands that may not touch are left out. If a list has
// no room, the frame halts (endLists) until the host has enlarged the buffers.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/contact_search.glsl"

uint list;       // where the list of this invocation starts
uint count = 0;  // pairs in it
uint block = 0;  // the last block of it

void append(ContactPair pair) {
  if (count % kListBlock == 0) {
    block = atomicAdd(control.blocks, 1);
    if (count / kListBlock < numbers.mostBlocks) lists[listedBlock(list, count / kListBlock)] = block;
  }
  // Without room, pairs are still counted, so that the host knows how many are needed.
  if (block < numbers.blockCount) pairs[block * kListBlock + count % kListBlock] = pair;
  ++count;
}

// A pair is listed because of its distance alone, or of its distance and the speed of its approach.
bool isSought(vec3 otherPosition, vec3 otherVelocity, uint otherParticle, float r0) {
  precise vec3 apart = x - otherPosition;
  precise float squared = apart.x * apart.x + apart.y * apart.y + apart.z * apart.z;
  float ahead = numbers.seconds * length(v - otherVelocity);
  float reach = min(max(r0 + ahead, numbers.reachFactor * r0), numbers.listedAhead * r0) + numbers.skin;
  return squared < reach * reach;
}

void take(ContactRest other, float R, float r0) {
  vec2 constants = contactConstants(0.5 * (rest.mass + other.mass), R, numbers);
  append(ContactPair(other.particle, r0, constants.x, constants.y));
}

void main() {
  readControl();
  uint longest = control.longestList;
  uint place = gl_GlobalInvocationID.x;
  if (place >= placedCount()) return;
  uint c = placedVelocity(place).w;
  list = listOf(c);
  if (isElsewhere(contactOf(c).strand)) {
    lists[list] = 0;
    setListed(c, uintBitsToFloat(placedPosition(place).xyz), uintBitsToFloat(placedVelocity(place).xyz));
    return;
  }
  uvec4 self = placedPosition(place);
  vec3 velocity = uintBitsToFloat(placedVelocity(place).xyz);
  if (!search(c, uintBitsToFloat(self.xyz), velocity, self.w, numbers.skin, 0, kSearchRows))
    control.isHalted = kHaltedByTurns;
  lists[list] = count;
  if (count > longest) atomicMax(control.longestList, count);
  setListed(c, x, v);
  atomicAdd(control.listed, count);
}
