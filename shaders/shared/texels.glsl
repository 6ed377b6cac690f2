// Records of 16 bytes, read as texels where the device sees enough of them, else from storage. The same bytes are bound
// twice; which way is specialized. A texel costs lavapipe a fifth of a storage record, where it looks lane by lane.
// For what this dispatch does not write, or reads before it writes.
#ifndef RINGLET_TEXELS
#define RINGLET_TEXELS

#include "layout/types.h"

layout(constant_id = kSpecTexels) const bool kTexels = false;

uvec4 recordAt(usamplerBuffer texels, uint i) { return texelFetch(texels, int(i)); }
vec4 vectorAt(usamplerBuffer texels, uint i) { return uintBitsToFloat(texelFetch(texels, int(i))); }

#endif
