// The positions at a frame's end, as they are copied to the host: binding numbers, push constants.
#ifndef RINGLET_LAYOUT_FRAME
#define RINGLET_LAYOUT_FRAME

#include "layout/types.h"

#ifdef __cplusplus
namespace ringlet::layout {
#endif

// Bindings of frame_positions.comp, in set 0.
RINGLET_CONSTANT uint kBindFramePositions = 0;  // vec4[particles of a chunk]
RINGLET_CONSTANT uint kBindFramePlaces = 1;     // uint[particles of a chunk]: place of each in the frame, or
                                                // kNoPlace
RINGLET_CONSTANT uint kBindFrameOut = 2;        // float[3 x (end - begin)], in host memory

RINGLET_CONSTANT uint kNoPlace = 0xffffffffu;  // place of a particle that another device steps

struct FrameParameters {
  uint count;  // particles of the chunk
  uint begin;  // places [begin, end) are in this buffer
  uint end;
};

#ifdef __cplusplus
}  // namespace ringlet::layout
#endif
#endif
