// The parcels in the eight cells around a node of the volume's grid. Neighbouring cells along x are consecutive, so the
// eight are four rows of parcels.
#ifndef RINGLET_VOLUME_ROWS
#define RINGLET_VOLUME_ROWS

#include "shared/volume_buffers.glsl"

// Parcel t around the node stands at t + shift of the first row whose end is beyond t.
struct Rows {
  uvec4 shift, end;
};

// a / b; exact for a < 2^21, and faster than an integer division.
uint quotient(uint a, uint b) { return uint((float(a) + 0.5) / float(b)); }

uvec3 placeOfNode(uint node) {
  uint row = quotient(node, box.size.x);
  uint z = quotient(row, box.size.y);
  return uvec3(node - row * box.size.x, row - z * box.size.y, z);
}

Rows rowsAround(uvec3 at) {
  Rows rows = Rows(uvec4(0), uvec4(0));
  uint all = 0;
  [[unroll]] for (uint k = 0; k < 4; ++k) {
    uint y = at.y - (k & 1);
    uint z = at.z - (k >> 1);
    bool isIn = y < box.size.y && z < box.size.z;  // coordinates below 0 wrap to large numbers
    uint last = isIn ? (z * box.size.y + y) * box.size.x + at.x : 0;
    uint first = isIn ? startOf(last - min(at.x, 1)) : 0;
    uint end = isIn ? startOf(last + 1) : 0;
    rows.shift[k] = first - all;
    all += end - first;
    rows.end[k] = all;
  }
  return rows;
}
uint placeIn(Rows rows, uint t) {
  uint upper = t < rows.end.z ? rows.shift.z : rows.shift.w;
  return t + (t < rows.end.x ? rows.shift.x : t < rows.end.y ? rows.shift.y : upper);
}

/// Nodes with so many parcels around them are in one bin: four bins from a power of two to the next.
uint binOf(uint count) { return min((floatBitsToUint(float(count)) >> 21) - (127u << 2), kNodeBins - 1); }

#endif
