// The buffers and parameters of part_pack.comp and part_unpack.comp (layout/parts.h). Floats are moved as
// integers: a driver may flush a small float to 0.
#ifndef RINGLET_PART_BUFFERS
#define RINGLET_PART_BUFFERS

#include "layout/parts.h"
#include "shared/workgroup.glsl"

layout(set = 0, binding = kBindPartPositions) buffer Positions { uvec4 positions[]; };
layout(set = 0, binding = kBindPartVelocities) buffer Velocities { uvec4 velocities[]; };
layout(set = 0, binding = kBindPartSolved) buffer Solved { uvec4 solved[]; };
layout(set = 0, binding = kBindPartParticles) readonly buffer Particles { uint particles[]; };
layout(set = 0, binding = kBindPartRows) buffer Rows { uint rows[]; };
layout(push_constant) uniform Parameters { PartParameters parameters; };

#endif
