// Reads records of 16 bytes as texels if the device's texel buffers are large enough, else from storage
// buffers. The same bytes are bound both ways; a specialization constant chooses. On lavapipe a texel costs a
// fifth of a storage record, which it reads lane by lane. Use texels only for buffers that the dispatch does
// not write, or reads before it writes them.
#ifndef RINGLET_TEXELS
#define RINGLET_TEXELS

#include "layout/types.h"

layout(constant_id = kSpecTexels) const bool kTexels = false;

uvec4 recordAt(usamplerBuffer texels, uint i) { return texelFetch(texels, int(i)); }
vec4 vectorAt(usamplerBuffer texels, uint i) { return uintBitsToFloat(texelFetch(texels, int(i))); }

#endif
