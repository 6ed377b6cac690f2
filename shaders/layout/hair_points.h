// Points of hairs, uvec4 each: the position's bits [m], then a tag. follow_* and pose_* kernels write them, render_*
// kernels read them.
#ifndef RINGLET_LAYOUT_HAIR_POINTS
#define RINGLET_LAYOUT_HAIR_POINTS

#include "layout/types.h"

#ifdef __cplusplus
namespace ringlet::layout {
#endif

// The tag is the index of the hair. This bit is set if no edge follows: at its last point, and before a cut.
RINGLET_CONSTANT uint kHairEnd = 0x80000000u;

#ifdef __cplusplus
}  // namespace ringlet::layout
#endif
#endif
