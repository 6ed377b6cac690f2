// Sets each hair's pigment by how far the longest edge of its strand is stretched: 0 at rest, 1 at the
// scale's end.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "layout/picture.h"

layout(local_size_x_id = kSpecGroupSize) in;
layout(set = 0, binding = kBindStretchPoints) readonly buffer Points { uvec4 points[]; };
layout(set = 0, binding = kBindStretchLengths) readonly buffer Lengths { float lengths[]; };
layout(set = 0, binding = kBindStretchStrands) readonly buffer Strands { StretchStrand strands[]; };
layout(set = 0, binding = kBindStretchHairs) buffer Hairs { DrawnHair hairs[]; };
layout(push_constant) uniform Parameters { StretchParameters parameters; };

void main() {
  uint h = gl_GlobalInvocationID.x;
  if (h >= parameters.count) return;
  StretchStrand strand = strands[h];
  float most = 0.0;
  for (uint i = strand.firstPoint; i + 1 < strand.firstPoint + strand.pointCount; ++i) {
    if ((points[i].w & kHairEnd) != 0) continue;  // cut
    float now = distance(uintBitsToFloat(points[i].xyz), uintBitsToFloat(points[i + 1].xyz));
    most = max(most, now / lengths[i] - 1.0);
  }
  hairs[h].pigment = clamp(most / parameters.most, 0.0, 1.0);
}
