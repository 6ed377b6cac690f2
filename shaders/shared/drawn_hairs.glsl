// Points and looks of the hairs that are drawn.
#ifndef RINGLET_DRAWN_HAIRS
#define RINGLET_DRAWN_HAIRS

#include "shared/picture.glsl"

layout(set = 0, binding = kBindDrawnPoints) readonly buffer DrawnPoints { uvec4 drawnPoints[]; };
layout(set = 0, binding = kBindDrawnHairs) readonly buffer DrawnHairs { DrawnHair drawnHairs[]; };
layout(set = 0, binding = kRenderTexels + kBindDrawnPoints) uniform usamplerBuffer drawnPointTexels;
layout(set = 0, binding = kRenderTexels + kBindDrawnHairs) uniform usamplerBuffer drawnHairTexels;

uvec4 pointRecord(uint i) { return kTexels ? recordAt(drawnPointTexels, i) : drawnPoints[i]; }
vec3 hairPoint(uint i) { return uintBitsToFloat(pointRecord(i).xyz); }
DrawnHair drawnHair(uint h) {
  if (!kTexels) return drawnHairs[h];
  uvec4 hair = recordAt(drawnHairTexels, h);
  return DrawnHair(hair.x, hair.y, uintBitsToFloat(hair.z), uintBitsToFloat(hair.w));
}
/// share: of the way from root to tip. Hairs keep their width and become thin only towards the tip.
float radiusAt(DrawnHair hair, float share) {
  return hair.radius * (1.0 - (1.0 - picture.tipRadius) * share * share * share);
}

#endif
