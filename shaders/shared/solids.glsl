// Bodies that are drawn, as triangles with shared points.
#ifndef RINGLET_SOLIDS
#define RINGLET_SOLIDS

#include "shared/picture.glsl"

layout(set = 0, binding = kBindSolidPoints) readonly buffer SolidPoints { SolidPoint solidPoints[]; };
layout(set = 0, binding = kBindSolidTriangles) readonly buffer SolidTriangles { SolidTriangle solidTriangles[]; };
layout(set = 0, binding = kRenderTexels + kBindSolidPoints) uniform usamplerBuffer solidPointTexels;
layout(set = 0, binding = kRenderTexels + kBindSolidTriangles) uniform usamplerBuffer solidTriangleTexels;

vec4 solidPosition(uint i) { return kTexels ? vectorAt(solidPointTexels, 2 * i) : solidPoints[i].position; }
vec4 solidNormal(uint i) { return kTexels ? vectorAt(solidPointTexels, 2 * i + 1) : solidPoints[i].normal; }
uvec3 solidTriangle(uint t) {
  if (kTexels) return recordAt(solidTriangleTexels, t).xyz;
  return uvec3(solidTriangles[t].points[0], solidTriangles[t].points[1], solidTriangles[t].points[2]);
}

#endif
