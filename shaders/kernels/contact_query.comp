// Lists: every contact particle's pairs, from the 27 cells about it, in the order of cells and of contact particles inside
// one. Pairs of strands that may not touch are left out; a pair that was listed before keeps its life. A list that is too
// long stops the frame, and the host makes room.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/contact_buffers.glsl"

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

// The pair's life so far, from the row that was in use.
vec2 lifeOf(uint c, uint particle) {
  uint row = 2 * c + (control.parity ^ 1);
  uint count = listCounts[row];
  for (uint j = 0; j < count; ++j) {
    if (pairs[pairOf(row, j)].particle == particle) {
      ContactLife life = lives[pairOf(row, j)];
      return vec2(life.stiffnessShare, life.dampingShare);
    }
  }
  return vec2(0);
}

void main() {
  uint place = gl_GlobalInvocationID.x;
  if (place >= parameters.contactCount) return;
  vec4 self = places[place].sorted;
  uint c = floatBitsToUint(self.w);
  ContactRest rest = contacts[c];
  precise vec3 x = self.xyz;
  vec3 v = solved[rest.particle].xyz;
  float T = parameters.seconds;
  float seenAhead = max(parameters.seenAhead, parameters.breakFactor);
  precise float farthest = seenAhead * (rest.point.w + parameters.largestRadius) + parameters.skin;
  ivec3 cell = cellOf(x);
  uint row = rowOf(c);
  uint count = 0;
  for (int z = cell.z - 1; z <= cell.z + 1; ++z) {
    for (int y = cell.y - 1; y <= cell.y + 1; ++y) {
      // Three cells along x: a range of entries, which may go on from the last bucket to the first.
      uint first = bucketOf(ivec3(cell.x - 1, y, z));
      uint end = first + 3;
      uint entry = startOf(first);
      uint entries = startOf(min(end, parameters.bucketCount)) - entry;
      if (end > parameters.bucketCount) entries += startOf(end - parameters.bucketCount);
      for (; entries > 0; --entries, ++entry) {
        if (entry == parameters.contactCount) entry = 0;
        vec4 near = places[entry].sorted;
        precise vec3 apart = x - near.xyz;
        precise float squared = apart.x * apart.x + apart.y * apart.y + apart.z * apart.z;
        if (!(squared < farthest * farthest)) continue;
        uint b = floatBitsToUint(near.w);
        if (b == c) continue;
        // Other cells may share a bucket, and a bucket may come by twice.
        ivec3 nearCell = cellOf(near.xyz);
        if (nearCell.y != y || nearCell.z != z || abs(nearCell.x - cell.x) > 1) continue;
        ContactRest other = contacts[b];
        if (rest.inverseMassUnit == 0.0 && other.inverseMassUnit == 0.0) continue;
        if (!mayTouch(rest.strand, other.strand)) continue;

        float R = rest.point.w + other.point.w;
        float r0 = min(R, distance(rest.point.xyz, other.point.xyz));
        float ahead = T * length(v - solved[other.particle].xyz);
        precise float reach = min(parameters.breakFactor * r0 + ahead, seenAhead * r0) + parameters.skin;
        if (!(squared < reach * reach)) continue;
        if (count < parameters.stride) {
          float mass = 0.5 * (rest.mass + other.mass);
          float k = parameters.stiffness * mass / R;
          pairs[pairOf(row, count)] =
              ContactPair(other.particle, r0, k, 2.0 * parameters.dampingRatio * sqrt(k * mass));
          vec2 life = lifeOf(c, other.particle);
          lives[pairOf(row, count)] = ContactLife(life.x, life.y, 0.0, 0.0);
        }
        ++count;
      }
    }
  }
  listCounts[row] = min(count, parameters.stride);
  places[c].position = vec4(x, 0);
  places[c].velocity = vec4(v, 0);
  atomicAdd(control.listed, count);
  if (count > control.longestList) atomicMax(control.longestList, count);
  if (count > parameters.stride) control.isHalted = 1;
}
