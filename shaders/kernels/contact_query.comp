// Lists: every contact particle's pairs, from the 27 cells about it, in the order of cells and of contact particles
// inside one. Pairs of strands that may not touch are left out. Where there is no room the frame stops
// (contact_check.comp), and the host makes some.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/contact_buffers.glsl"
#include "equations/contact_spring.glsl"

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

uvec4 neighbourRecord(uint i) { return kTexels ? recordAt(neighbourTexels, i) : neighbours[i]; }

// own: record of this invocation's strand. As solver/neighbour_table.h fills the table.
bool mayTouch(uvec4 own, uint strand) {
  uint bucket = strand * 2654435761u >> 16;
  uint tried = 0;
  do {
    uvec4 four = neighbourRecord(own.x + (bucket & own.y));
    if (any(equal(four, uvec4(strand)))) return true;
    if (any(equal(four, uvec4(kNoStrand)))) return false;
    ++bucket;
  } while (++tried <= own.y);
  return false;
}

void main() {
  uint place = gl_GlobalInvocationID.x;
  if (place >= parameters.contactCount) return;
  uvec4 self = placedPosition(place);
  uint c = self.w;
  ContactRest rest = contactOf(c);
  uvec4 ownNeighbours = parameters.everyPair != 0 ? uvec4(0) : neighbourRecord(rest.strand);
  precise vec3 x = uintBitsToFloat(self.xyz);
  vec3 v = uintBitsToFloat(placedVelocity(place).xyz);
  // No pair's reach is larger: by the radii, and by the fastest there is.
  float mostR = rest.point.w + parameters.largestRadius;
  precise float farthest = min(parameters.seenAhead * mostR + parameters.skin, control.cellSize);
  ivec3 cell = cellOf(x);
  list = listOf(c);
  uint wanted = 9;  // turns of the loops below; and how many they made
  uint made = 0;
  int row = 0;
  do {
    // Three cells along x: a range of entries, which may go on from the last bucket to the first.
    ivec3 middle = cell + ivec3(0, row % 3 - 1, row / 3 - 1);
    uint first = bucketOf(middle - ivec3(1, 0, 0));
    uint entry = startOf(first);
    uint entries = startOf(min(first + 3, parameters.bucketCount)) - entry;
    if (first + 3 > parameters.bucketCount) entries += startOf(first + 3 - parameters.bucketCount);
    if (entries > 0) do {
      if (entry == parameters.contactCount) entry = 0;
      uint looked = min(min(entries, 32), parameters.contactCount - entry);
      // Three sieves, finer and dearer each, over what is left as bits: a driver that runs invocations in step does for
      // all
      // of them what a single one must. And it runs the body of a loop that asks before it once more than there are
      // turns;
      // hence if and do.
      uint near = 0;
      uint k = 0;
      do {
        precise vec3 apart = x - placedAt(entry + k);
        precise float squared = apart.x * apart.x + apart.y * apart.y + apart.z * apart.z;
        if (squared < farthest * farthest) near |= 1u << k;
        ++made;
      } while (++k < looked);
      wanted += looked + bitCount(near);
      uint meeting = 0;  // near enough for how fast the two near each other
      if (near != 0) do {
        uint k = findLSB(near);
        near &= near - 1;
        ++made;
        vec3 apart = x - placedAt(entry + k);
        uvec4 other = placedVelocity(entry + k);
        float ahead = parameters.seconds * length(v - uintBitsToFloat(other.xyz));
        float reach = 1.0001 * (min(mostR + ahead, parameters.seenAhead * mostR) + parameters.skin);
        bool mayMeet = dot(apart, apart) < reach * reach && other.w != rest.strand;
        if (mayMeet) meeting |= 1u << k;
      } while (near != 0);
      wanted += bitCount(meeting);
      if (meeting != 0) do {
        uint k = findLSB(meeting);
        meeting &= meeting - 1;
        ++made;
        uvec4 found = placedPosition(entry + k);
        vec3 foundAt = uintBitsToFloat(found.xyz);
        vec3 otherVelocity = uintBitsToFloat(placedVelocity(entry + k).xyz);
        ContactRest other = contactOf(found.w);
        // Other cells may share a bucket, and a bucket may come by twice.
        ivec3 away = cellOf(foundAt) - middle;
        bool isCandidate = away.y == 0 && away.z == 0 && abs(away.x) <= 1 &&
                           !(rest.inverseMassUnit == 0.0 && other.inverseMassUnit == 0.0);
        precise vec3 apart = x - foundAt;
        precise float squared = apart.x * apart.x + apart.y * apart.y + apart.z * apart.z;
        float r0 = contactRestLength(rest.point.w + other.point.w, distance(rest.point.xyz, other.point.xyz));
        float ahead = parameters.seconds * length(v - otherVelocity);
        float reach = min(r0 + ahead, parameters.seenAhead * r0) + parameters.skin;
        if (!isCandidate || !(squared < reach * reach)) continue;
        if (parameters.everyPair == 0 && !mayTouch(ownNeighbours, other.strand)) continue;
        append(ContactPair(other.particle, r0));
      } while (meeting != 0);
      entry += looked;
      entries -= looked;
    } while (entries > 0);
    ++made;
  } while (++row < 9);
  lists[list] = count;
  if (count > control.longestList) atomicMax(control.longestList, count);
  histories[c].position = vec4(x, 0);
  histories[c].velocity = vec4(v, 0);
  atomicAdd(control.listed, count);
  if (made != wanted) control.isHalted = kHaltedByTurns;
}
