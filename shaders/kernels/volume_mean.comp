// If strands are divided among devices: computes the mean at each node from the sums over the particles of all devices,
// and in a step that sorts particles into cells the density. The reference has no counterpart: it has all strands.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "maths/split_sum.glsl"
#include "shared/volume_buffers.glsl"

void main() {
  readBox();
  uint node = gl_GlobalInvocationID.x;
  if (halt.isHalted != 0 || node >= box.cellCount) return;
  ivec4 high, low;
  for (uint k = 0; k < 4; ++k) {
    high[k] = sums[nodeSum(node) + k];
    low[k] = sums[nodeSum(node) + 4 + k];
  }
  nodes[node].xyz = meanRate(fromSums(high, low));
  if (parameters.sorts == 0) return;
  vec4 density = fromSums(ivec4(sums[densitySum(node)]), ivec4(sums[densitySum(node) + 1]));
  nodes[node].w = densityFrom(density.x);
}
