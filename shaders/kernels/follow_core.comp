// The core of every guide at each of its particles: a weighted sum of neighbouring particles;
// src/ringlet/follow/core_weights.h derives the weights from measure/core.h. Mirrored by
// reference/follow_guide.h.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/follow_buffers.glsl"

layout(set = 0, binding = kBindCores) writeonly buffer Cores { vec4 cores[]; };

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= parameters.count) return;
  CoreRow row = coreRow(i);
  uint last = parameters.particles - 1;
  vec3 sum = vec3(0);
  // Lanes leave at different turns: a value that is read after the loop must be carried by it, which does not
  // hold for a do-while.
  for (uint k = 0; k < row.recordCount; ++k) {
    vec4 weights = coreWeight(row.firstRecord + k);
    uint first = row.firstParticle + 4 * k;
    sum += weights.x * guidePoint(min(first, last)) + weights.y * guidePoint(min(first + 1, last)) +
           weights.z * guidePoint(min(first + 2, last)) + weights.w * guidePoint(min(first + 3, last));
  }
  cores[i] = vec4(sum, 0);
}
