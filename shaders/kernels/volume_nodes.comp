// Computes at each node of the volume's grid the mean of the contributions of the eight cells around it, and in the
// first iteration of a step that sorts the density; if strands are divided among devices, the sums over the particles
// here. Mirrored by reference/kernels/volume_step.h.
#version 450
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require
#include "maths/split_sum.glsl"
#include "shared/volume_buffers.glsl"

void main() {
  readBox();
  uint k = gl_GlobalInvocationID.x;
  if (halt.isHalted != 0 || k >= (kDivided ? box.cellCount : box.reached)) return;
  uint node = kDivided ? k : cellNumber(reachedNode(k));
  uvec3 at = placeOfCell(node);
  ivec4 high = ivec4(0), low = ivec4(0), masses = ivec4(0);
  [[unroll]] for (uint corner = 0; corner < 8; ++corner) {
    uvec3 away = cornerOf(uvec3(0), corner);
    uint slot = all(greaterThanEqual(at, away)) ? cellNumber(slotOf(cellIndex(at - away))) : kNoSlot;
    if (slot == kNoSlot) continue;
    high += cornerSumAt(cornerSum(slot, corner));
    low += cornerSumAt(cornerSum(slot, corner) + 1);
    if (parameters.sorts != 0) masses += cornerSumAt(cornerMass(slot, corner));
  }
  carry(high, low);
  ivec4 massHigh = masses.xxxx, massLow = masses.yyyy;
  carry(massHigh, massLow);
  if (!kDivided) {
    nodes[node].xyz = meanRate(fromSums(high, low));
    if (parameters.sorts != 0) nodes[node].w = densityFrom(fromSums(massHigh, massLow).x);
    return;
  }
  for (uint j = 0; j < 4; ++j) {
    sums[nodeSum(node) + j] = high[j];
    sums[nodeSum(node) + 4 + j] = low[j];
  }
  if (parameters.sorts == 0) return;
  sums[densitySum(node)] = massHigh.x;
  sums[densitySum(node) + 1] = massLow.x;
}
