// Computes for each cell of the volume's grid that has parcels what these contribute to the cell's eight nodes; in the
// first iteration of a step that sorts particles into cells also how much mass. Terms are integers, so that no sum
// depends on their order, and split (maths/split_sum.glsl). On a GPU each corner has an invocation of its own: a
// dispatch takes as long as the longest sum, of a crowded cell. On a CPU device one invocation has all corners, so that
// each parcel is read once. Mirrored by reference/kernels/volume_step.h.
#version 450
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require
#include "maths/split_sum.glsl"
#include "shared/at_once.glsl"
#include "shared/volume_buffers.glsl"

const uint kCorners = kForGpu ? 1 : 8;         // of an invocation
const uint kTogether = kForGpu ? kAtOnce : 1;  // parcels that an invocation loads before it uses the first

uint firstCorner = 0;
ivec4 high[kCorners];
ivec4 low[kCorners];

/// A parcel's weight at a corner of its cell, from those along each axis at the lower and the upper nodes.
float cornerWeight(vec3 lower, vec3 upper, uvec3 corner) {
  vec3 w = mix(lower, upper, equal(corner, uvec3(1)));
  return w.x * w.y * w.z;
}

/// Adds a parcel to the sums. node: the cell's first; cellInRate: cell size as a share of mostRate, so that C has the
/// unit of a parcel's rate [s]; isThere: false adds nothing. `precise`: the same bits in both forms.
void add(VolumeParcel parcel, vec3 node, float cellInRate, bool isThere) {
  vec3 inCell = parcel.place.xyz - node;
  vec3 lower = nodeWeights(inCell), upper = nodeWeights(inCell - 1.0);
  float g = isThere ? parcel.rate.w : 0.0;
  mat3 across = (g * cellInRate) * gradientOf(parcel);  // change from one node to the next
  precise vec3 first = parcel.rate.xyz - across * inCell;
  [[unroll]] for (uint k = 0; k < kCorners; ++k) {
    uvec3 corner = cornerOf(uvec3(0), firstCorner + k);
    precise vec3 there = first + across * vec3(corner);
    vec4 rate = vec4(clamp(there, vec3(-g), vec3(g)), g);
    ivec4 term = ivec4(roundEven(cornerWeight(lower, upper, corner) * rate));
    high[k] += term >> 16;
    low[k] += term & 0xffff;
  }
}

void carryAll() {
  [[unroll]] for (uint k = 0; k < kCorners; ++k) carry(high[k], low[k]);
}

void sumRates(uint first, uint end, vec3 node, float cellInRate) {
  [[unroll]] for (uint k = 0; k < kCorners; ++k) high[k] = low[k] = ivec4(0);
  uint turn = 0;
  uint t = first;
  do {
    VolumeParcel some[kTogether];
    [[unroll]] for (uint j = 0; j < kTogether; ++j) some[j] = parcelAt(min(t + j, end - 1));
    [[unroll]] for (uint j = 0; j < kTogether; ++j)
      add(some[j], node, cellInRate, kTogether == 1 || t + j < end);
    if ((++turn & 0xfff) == 0) carryAll();
    t += kTogether;
  } while (t < end);
  carryAll();
  if (t < end) halt.isHalted = kHaltedByTurns;  // the driver ended the loop early
}

void sumMasses(uint first, uint end, vec3 node) {
  [[unroll]] for (uint k = 0; k < kCorners; ++k) high[k] = low[k] = ivec4(0);
  uint turn = 0;
  uint t = first;
  do {
    vec3 inCell = parcelPlace(t) - node;
    vec3 lower = nodeWeights(inCell), upper = nodeWeights(inCell - 1.0);
    float mass = uintBitsToFloat(cellNumber(parcelMass(t)));
    [[unroll]] for (uint k = 0; k < kCorners; ++k) {
      int term = int(roundEven(cornerWeight(lower, upper, cornerOf(uvec3(0), firstCorner + k)) * mass));
      high[k].x += term >> 16;
      low[k].x += term & 0xffff;
    }
    if ((++turn & 0x3fff) == 0) carryAll();
  } while (++t < end);
  carryAll();
  if (t < end) halt.isHalted = kHaltedByTurns;
}

/// The workgroup's place in the order of cells, the most crowded first. A CPU device gives each of its threads as many
/// consecutive workgroups: these must not all have crowded cells. The number of workgroups is a multiple of kDealt.
uint groupInOrder() {
  uint perDeal = gl_NumWorkGroups.x / kDealt;
  return kForGpu ? gl_WorkGroupID.x : gl_WorkGroupID.x % perDeal * kDealt + gl_WorkGroupID.x / perDeal;
}

void main() {
  readBox();
  uint invocation = groupInOrder() * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
  uint k = invocation / (8 / kCorners);
  firstCorner = kCorners * (invocation % (8 / kCorners));
  if (halt.isHalted != 0 || k >= box.filled) return;
  uint slot = box.filled - 1 - k;
  uint cell = cellNumber(filledCell(slot));
  uint first = startOf(cell), end = startOf(cell + 1);
  vec3 node = vec3(placeOfCell(cell));
  sumRates(first, end, node, box.cell / numbers.mostRate);
  [[unroll]] for (uint j = 0; j < kCorners; ++j) {
    cornerSums[cornerSum(slot, firstCorner + j)] = high[j];
    cornerSums[cornerSum(slot, firstCorner + j) + 1] = low[j];
  }
  if (parameters.sorts == 0) return;
  sumMasses(first, end, node);
  [[unroll]] for (uint j = 0; j < kCorners; ++j)
    cornerSums[cornerMass(slot, firstCorner + j)] = ivec4(high[j].x, low[j].x, 0, 0);
}
