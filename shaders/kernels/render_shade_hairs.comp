// Shades every sample in which hair is visible. The position of a sample on its edge follows from the
// positions of both in the picture.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/drawn_hairs.glsl"
#include "shared/lighting.glsl"

layout(set = 0, binding = kBindSamples) buffer Samples { uvec2 samples[]; };
layout(set = 0, binding = kBindSeen) readonly buffer Seen { uint seen[]; };
layout(set = 0, binding = kBindSeenCounts) readonly buffer Counts { SeenCounts counts; };

void main() {
  if (gl_GlobalInvocationID.x >= counts.hairs) return;
  uint at = seen[gl_GlobalInvocationID.x];
  uint p = samples[at].x - 1;
  uvec4 record = pointRecord(p);
  DrawnHair hair = drawnHair(record.w);
  uint i = p - hair.firstPoint;
  vec3 a = uintBitsToFloat(record.xyz);
  vec3 b = hairPoint(p + 1);
  vec3 before = i > 0 && (pointRecord(p - 1).w & kHairEnd) == 0 ? hairPoint(p - 1) : a;
  vec3 after = (pointRecord(p + 1).w & kHairEnd) == 0 ? hairPoint(p + 2) : b;

  uint stride = picture.side * picture.width;
  vec2 place = vec2(at % stride, at / stride) + 0.5 + vec2(0, bandTop());
  vec2 from = inSamples(inView(a));
  vec2 way = inSamples(inView(b)) - from;
  float t = clamp(dot(place - from, way) / max(dot(way, way), 1e-12), 0.0, 1.0);
  vec3 tangent = normalize(mix(normalize(b - before), normalize(after - a), t));

  float vary = unitOf(mixed(record.w + 7u));
  float among = hair.pigment * float(picture.pigmentCount - 1);
  uint first = min(uint(among), picture.pigmentCount - 2);
  vec3 pigment = mix(picture.pigments[first].rgb, picture.pigments[first + 1].rgb, among - float(first));
  vec3 absorption = pigment * mix(0.85, 1.2, vary);
  HairFibre fibre = HairFibre(absorption, picture.along, picture.about, picture.tilt);
  vec3 colour = min(shadedHair(mix(a, b, t), tangent, fibre), vec3(60000));
  samples[at] = uvec2(packHalf2x16(colour.xy), packHalf2x16(vec2(colour.z, 0)) | kShadedHair);
}
