// Adds the area of hair to the boxes of the lights and of the sky: every n-th hair, with weight n. Sums of
// integers, which do not depend on the order.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/drawn_hairs.glsl"
#include "shared/shadow_volume.glsl"

void main() {
  uint k = gl_GlobalInvocationID.x / picture.pointsPerHair;
  uint i = gl_GlobalInvocationID.x - k * picture.pointsPerHair;
  uint h = k * picture.shadowStride;
  if (h >= picture.hairCount) return;
  DrawnHair hair = drawnHair(h);
  if (i + 1 >= hair.pointCount) return;
  uint p = hair.firstPoint + i;
  uvec4 record = pointRecord(p);
  if ((record.w & kHairEnd) != 0) return;
  vec3 from = uintBitsToFloat(record.xyz);
  vec3 edge = hairPoint(p + 1) - from;
  float share = (float(i) + 0.5) / float(hair.pointCount - 1);
  float width = 2.0 * radiusAt(hair, share) * picture.shadowOpacity * float(picture.shadowStride);
  vec2 areas = width * vec2(length(cross(edge, picture.lightDirection[0].xyz)),
                            length(cross(edge, picture.lightDirection[1].xyz)));
  addAt(from + unitOf(mixed(p)) * edge, areas, 0.785398 * width * length(edge));
}
