// Shades every pixel in which a body is visible, at one of the samples that show it.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/lighting.glsl"
#include "shared/solids.glsl"

layout(set = 0, binding = kBindSeenSolids) readonly buffer SeenSolids { uvec2 seenSolids[]; };
layout(set = 0, binding = kBindSeenCounts) readonly buffer Counts { SeenCounts counts; };
layout(set = 0, binding = kBindSolidColours) writeonly buffer SolidColours { uvec2 solidColours[]; };

void main() {
  if (gl_GlobalInvocationID.x >= counts.solids) return;
  uvec2 here = seenSolids[gl_GlobalInvocationID.x];
  uvec3 corners = solidTriangle(here.y);
  vec4 first = solidPosition(corners.x);
  vec3 a = first.xyz;
  vec3 b = solidPosition(corners.y).xyz;
  vec3 c = solidPosition(corners.z).xyz;

  // The ray through the sample, up to its intersection with the triangle.
  uint pixel = here.x >> 4;
  uint index = here.x & 15u;
  uint y = pixel / picture.width;
  uint down = index / picture.side;
  vec2 inPixel = (vec2(index - down * picture.side, down) + 0.5) / float(picture.side);
  vec2 place = vec2(pixel - y * picture.width, y + band.firstRow) + inPixel;
  vec2 aside = (place - 0.5 * vec2(picture.width, picture.height)) / picture.focus;
  vec3 way = normalize(picture.view[2].xyz + aside.x * picture.view[0].xyz - aside.y * picture.view[1].xyz);
  vec3 face = cross(b - a, c - a);
  float slant = dot(face, way);
  vec3 x = picture.eye.xyz + way * (dot(face, a - picture.eye.xyz) / (abs(slant) > 1e-20 ? slant : 1e-20));
  float size = dot(face, face);
  float v = clamp(dot(cross(x - a, c - a), face) / size, 0.0, 1.0);
  float w = clamp(dot(cross(b - a, x - a), face) / size, 0.0, 1.0 - v);
  x = a + v * (b - a) + w * (c - a);
  vec4 normal = (1.0 - v - w) * solidNormal(corners.x) + v * solidNormal(corners.y) + w * solidNormal(corners.z);
  uint kind = uint(first.w + 0.5);
  bool isFromBehind = kind == kSolidCloth && dot(normal.xyz, way) > 0.0;
  vec3 towards = normalize(isFromBehind ? -normal.xyz : normal.xyz);
  vec3 colour = min(shadedSolid(x, towards, picture.solidColours[kind].rgb), vec3(60000));
  solidColours[pixel] = uvec2(packHalf2x16(colour.xy), packHalf2x16(vec2(colour.z, 1.0 - normal.w)));
}
