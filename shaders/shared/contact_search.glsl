// Searches the 27 cells around a contact particle, in the order of cells and, within a cell, of contact particles, for
// particles of strands that may touch its own. The kernel that includes this defines which of them it wants (isSought)
// and what is done with them (take).
#ifndef RINGLET_CONTACT_SEARCH
#define RINGLET_CONTACT_SEARCH

#include "equations/contact_spring.glsl"
#include "shared/contact_buffers.glsl"

ContactRest rest;  // this invocation's contact particle
vec3 x;
vec3 v;

bool isSought(vec3 otherPosition, vec3 otherVelocity, uint otherParticle, float r0);
void take(ContactRest other, float R, float r0);

// Looks up a strand in the table that solver/contacts/neighbour_table.h fills. own: record of this
// invocation's strand.
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

bool rowHasOthers(uint first, uint group) {
  bool others = false;
  for (uint k = 0; k < 3; ++k)
    others = others || hasOthers(grid[cellGroups((first + k) & (numbers.bucketCount - 1))], group);
  return others;
}

const int kSearchRows = 9;  // of three cells along x

// Searches around contact particle c with this position, velocity and group of its strand, in rows [row,
// rowEnd). skin: distance by which isSought looks farther than pairs that may touch within the step [m].
// Returns false if the driver ended a loop early.
bool search(uint c, vec3 position, vec3 velocity, uint group, float skin, int row, int rowEnd) {
  rest = contactOf(c);
  uvec4 ownNeighbours = numbers.everyPair != 0 ? uvec4(0) : neighbourRecord(rest.strand);
  precise vec3 here = position;
  x = here;
  v = velocity;
  // An upper bound of the reach of all pairs, from the largest radius and the largest speed.
  float mostR = rest.radius + numbers.largestRadius;
  precise float farthest = min(numbers.listedAhead * mostR + skin, now.cellSize);
  ivec3 cell = cellOf(x);
  uint placed = placedCount();
  uint wanted = rowEnd - row;  // turns that the loops below should make; `made` counts those they made
  uint made = 0;
  do {
    // Three cells along x are one range of entries, which may wrap from the last bucket to the first.
    ivec3 middle = cell + ivec3(0, row % 3 - 1, row / 3 - 1);
    uint first = bucketOf(middle - ivec3(1, 0, 0));
    uint entry = startOf(first);
    uint entries = startOf(min(first + 3, numbers.bucketCount)) - entry;
    if (first + 3 > numbers.bucketCount) entries += startOf(first + 3 - numbers.bucketCount);
    if (kInGroups && !rowHasOthers(first, group)) entries = 0;
    if (entries > 0) do {
      if (entry == placed) entry = 0;
      uint looked = min(min(entries, 32), placed - entry);
      // Three tests, each finer and costlier than the last, over the bits that the last one left: a driver that runs
      // invocations in lockstep runs an `if` for all of them. It also runs the body of a loop that tests its condition
      // first once more than the loop has turns; therefore `if` and `do`.
      uint near = 0;
      uint k = 0;
      do {
        uvec4 other = placedPosition(entry + k);
        precise vec3 apart = here - uintBitsToFloat(other.xyz);
        precise float squared = apart.x * apart.x + apart.y * apart.y + apart.z * apart.z;
        if (squared < farthest * farthest && other.w != group) near |= 1u << k;
        ++made;
      } while (++k < looked);
      wanted += looked + bitCount(near);
      uint meeting = 0;  // pairs that are close enough for the speed of their approach
      if (near != 0) do {
        uint k = findLSB(near);
        near &= near - 1;
        ++made;
        vec3 apart = x - uintBitsToFloat(placedPosition(entry + k).xyz);
        float ahead = numbers.seconds * length(v - uintBitsToFloat(placedVelocity(entry + k).xyz));
        float acting = max(mostR + ahead, numbers.reachFactor * mostR);
        float reach = 1.0001 * (min(acting, numbers.listedAhead * mostR) + skin);
        if (dot(apart, apart) < reach * reach) meeting |= 1u << k;
      } while (near != 0);
      wanted += bitCount(meeting);
      if (meeting != 0) do {
        uint k = findLSB(meeting);
        meeting &= meeting - 1;
        ++made;
        vec3 foundAt = uintBitsToFloat(placedPosition(entry + k).xyz);
        uvec4 found = placedVelocity(entry + k);
        vec3 otherVelocity = uintBitsToFloat(found.xyz);
        ContactRest other = contactOf(found.w);
        // Other cells may share a bucket, and the search may reach a bucket twice.
        ivec3 away = cellOf(foundAt) - middle;
        bool isCandidate = away.y == 0 && away.z == 0 && abs(away.x) <= 1 &&
                           !(rest.inverseMassUnit == 0.0 && other.inverseMassUnit == 0.0);
        float R = rest.radius + other.radius;
        float r0 = contactRestLength(R, distance(rest.point, other.point));
        if (!isCandidate || !isSought(foundAt, otherVelocity, other.particle, r0)) continue;
        if (numbers.everyPair == 0 && !mayTouch(ownNeighbours, other.strand)) continue;
        take(other, R, r0);
      } while (meeting != 0);
      entry += looked;
      entries -= looked;
    } while (entries > 0);
    ++made;
  } while (++row < rowEnd);
  return made == wanted;
}

#endif
