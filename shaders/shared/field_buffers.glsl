// Buffers of the force fields. Part of strand_buffers.glsl.
#ifndef RINGLET_FIELD_BUFFERS
#define RINGLET_FIELD_BUFFERS

#include "layout/fields.h"
#include "shared/texels.glsl"

layout(set = 0, binding = kBindFields) readonly buffer Fields { StepField stepFields[]; };
layout(set = 0, binding = kBindFieldNodes) readonly buffer FieldNodes { vec4 fieldNodes[]; };
layout(set = 0, binding = kBindFieldTexels) uniform usamplerBuffer fieldTexels;
layout(set = 0, binding = kBindFieldNodeTexels) uniform usamplerBuffer fieldNodeTexels;

StepField stepField(uint i) {
  if (!kTexels) return stepFields[i];
  vec4 r[kFieldRecords - 1];
  [[unroll]] for (uint k = 0; k < kFieldRecords - 1; ++k) r[k] = vectorAt(fieldTexels, kFieldRecords * i + k);
  uvec4 grid = recordAt(fieldTexels, kFieldRecords * i + kFieldRecords - 1);
  return StepField(r[0].xyz, r[0].w, r[1].xyz, r[1].w, r[2].xyz, r[2].w, r[3].x, r[3].y, r[3].z, r[3].w, r[4].x, r[4].y,
                   r[4].z, r[4].w, r[5], uint[3](grid.x, grid.y, grid.z), grid.w);
}
vec3 fieldNode(uint i) { return (kTexels ? vectorAt(fieldNodeTexels, i) : fieldNodes[i]).xyz; }

#endif
