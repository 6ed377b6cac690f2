// What kernels keep of bodies that bend: grids and ways of triangles of several times of a frame, copies; of cloth its
// tree (layout/mesh_fields.h). Buffers of strand_step. Only kernels compiled with RINGLET_BENDING have them.
#ifndef RINGLET_BODY_FIELDS
#define RINGLET_BODY_FIELDS

#include "layout/strands.h"
#include "shared/body_buffers.glsl"

#ifdef RINGLET_BENDING
layout(set = 0, binding = kBindBodyKeys) readonly buffer BodyKeys { uint bodyKeys[]; };
layout(set = 0, binding = kBindBodyWays) readonly buffer BodyWays { vec4 bodyWays[]; };
layout(set = 0, binding = kBindBodyKeyTexels) uniform usamplerBuffer bodyKeyTexels;
layout(set = 0, binding = kBindBodyWayTexels) uniform usamplerBuffer bodyWayTexels;

uint bodyKey(uint i) { return kTexels ? recordAt(bodyKeyTexels, i >> 2)[i & 3u] : bodyKeys[i]; }
vec4 bodyWay(uint i) { return kTexels ? vectorAt(bodyWayTexels, i) : bodyWays[i]; }
uint copyOf(float field) { return uint(field); }
uint cornerCount(BodyRest body) { return (body.cells[0] + 1) * (body.cells[1] + 1) * (body.cells[2] + 1); }

// Loop turns that a lane may spend on cloth in a dispatch; then what is left of it is held (cloth_contact.glsl). 0: no
// body is cloth.
layout(constant_id = kSpecCloth) const uint kClothTurns = 0;
const bool kCloth = kClothTurns != 0;
bool isCloth(BodyRest body) { return kCloth && body.shape == kShapeCloth; }
#endif

#endif
