// Lists: every contact particle's pairs, from the 27 cells about it, in the order of cells and of contact particles inside
// one. Pairs of strands that may not touch are left out; a pair that was listed before keeps its life. Where there is no
// room the frame stops (contact_check.comp), and the host makes some.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/contact_buffers.glsl"
#include "equations/contact_spring.glsl"

bool mayTouch(uint a, uint b) {
  if (a == b) return false;
  if (parameters.everyPair != 0) return true;
  uint low = neighbours[a];
  uint high = neighbours[a + 1];
  while (low < high) {
    uint middle = (low + high) / 2;
    uint found = neighbours[parameters.strandCount + 1 + middle];
    if (found == b) return true;
    if (found < b) {
      low = middle + 1;
    } else {
      high = middle;
    }
  }
  return false;
}

// The pair's life so far, from the row that was in use. Cells come in the same order as last time, mostly, so it is looked
// for where the last one was found, and onwards.
uint lastFound = 0;
uint turns = 0;  // of all loops
float sharesBefore(uint list, uint count, uint particle) {
  for (uint tried = 0; tried < count; ++tried, ++turns) {
    uint j = lastFound + tried < count ? lastFound + tried : lastFound + tried - count;
    ContactLife life = lifeAt(lifeOf(control.parity ^ 1, entryOf(list, j)));
    if (life.particle == particle) {
      lastFound = j + 1;
      return life.shares;
    }
  }
  return 0.0;
}

void main() {
  uint place = gl_GlobalInvocationID.x;
  if (place >= parameters.contactCount) return;
  vec4 self = sortedAt(place);
  uint c = floatBitsToUint(self.w);
  ContactRest rest = contactOf(c);
  precise vec3 x = self.xyz;
  vec3 v = velocityOf(rest.particle);
  float T = parameters.seconds;
  float seenAhead = max(parameters.seenAhead, parameters.breakFactor);
  // No pair's reach is larger: by the radii, and by the fastest there is.
  float mostR = rest.point.w + parameters.largestRadius;
  precise float farthest = min(seenAhead * mostR + parameters.skin, control.cellSize);
  ivec3 cell = cellOf(x);
  uint list = listOf(c, control.parity);
  uint oldList = listOf(c, control.parity ^ 1);
  uint oldCount = lists[oldList];
  uint count = 0;  // pairs in the list
  uint block = 0;  // its last
  for (int z = cell.z - 1; z <= cell.z + 1; ++z) {
    for (int y = cell.y - 1; y <= cell.y + 1; ++y) {
      // Three cells along x: a range of entries, which may go on from the last bucket to the first.
      uint first = bucketOf(ivec3(cell.x - 1, y, z));
      uint end = first + 3;
      uint entry = startOf(first);
      uint entries = startOf(min(end, parameters.bucketCount)) - entry;
      if (end > parameters.bucketCount) entries += startOf(end - parameters.bucketCount);
      while (entries > 0) {
        uint queued = 0;
        for (; entries > 0 && queued < kQueue; --entries, ++entry, ++turns) {
          if (entry == parameters.contactCount) entry = 0;
          vec4 near = sortedAt(entry);
          precise vec3 apart = x - near.xyz;
          precise float squared = apart.x * apart.x + apart.y * apart.y + apart.z * apart.z;
          if (!(squared < farthest * farthest)) continue;
          // Other cells may share a bucket, and a bucket may come by twice.
          ivec3 nearCell = cellOf(near.xyz);
          if (nearCell.y != y || nearCell.z != z || abs(nearCell.x - cell.x) > 1) continue;
          queues[c * kQueue + queued] = vec2(near.w, squared);
          ++queued;
        }
        // All invocations look at what they have found together; a driver that runs them in step would else do it for one
        // after the other.
        turns += 20 * queued;  // and those of mayTouch
        for (uint j = 0; j < queued; ++j) {
          vec2 near = queues[c * kQueue + j];
          uint b = floatBitsToUint(near.x);
          float squared = near.y;
          ContactRest other = contactOf(b);
          if (b == c || (rest.inverseMassUnit == 0.0 && other.inverseMassUnit == 0.0)) continue;
          float R = rest.point.w + other.point.w;
          float r0 = contactRestLength(R, distance(rest.point.xyz, other.point.xyz));
          float ahead = T * length(v - velocityOf(other.particle));
          // Near enough to touch while the list is good; or to be a contact that has not broken.
          float reach = min(r0 + ahead, parameters.seenAhead * r0) + parameters.skin;
          float lastReach = parameters.breakFactor * r0 + parameters.skin;
          bool mayBegin = squared < reach * reach;
          if (!mayBegin && !(squared < lastReach * lastReach)) continue;
          if (!mayTouch(rest.strand, other.strand)) continue;
          float shares = sharesBefore(oldList, oldCount, other.particle);
          if (!mayBegin && shares == 0.0) continue;
          float mass = 0.5 * (rest.mass + other.mass);
          float k = parameters.stiffness * mass / R;
          if (count % kListBlock == 0) {
            block = atomicAdd(control.blocks, 1);
            if (count / kListBlock < parameters.mostBlocks) lists[list + 1 + count / kListBlock] = block;
          }
          // Without room, what is wanted is still counted.
          if (block < parameters.blockCount) {
            uint own = block * kListBlock + count % kListBlock;
            pairs[own] = ContactPair(other.particle, r0, k, 2.0 * parameters.dampingRatio * sqrt(k * mass));
            lives[lifeOf(control.parity, own)] = ContactLife(shares, other.particle);
          }
          ++count;
        }
      }
    }
  }
  lists[list] = count;
  if (count > control.longestList) atomicMax(control.longestList, count);
  places[c].position = vec4(x, 0);
  places[c].velocity = vec4(v, 0);
  atomicAdd(control.listed, count);
  if (turns > parameters.mostTurns) control.isHalted = kHaltedByTurns;
}
