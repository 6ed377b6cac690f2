// Lets one workgroup of a dispatch do what follows on the work of all of them, so that this needs no dispatch of its
// own. The kernel that includes this has a buffer with control.finished, which is 0 between dispatches.
#ifndef RINGLET_LAST_GROUP
#define RINGLET_LAST_GROUP

#include "shared/workgroup.glsl"

shared bool isLast;

/// Whether all other workgroups of the dispatch have come here. Called once, by all invocations of each. Atomics then
/// see what the others did by atomics before; other reads and writes may not.
bool isLastGroup() {
  memoryBarrierBuffer();
  barrier();
  if (gl_LocalInvocationID.x == 0) {
    isLast = atomicAdd(control.finished, 1) + 1 == gl_NumWorkGroups.x;
    if (isLast) control.finished = 0;
  }
  memoryBarrierBuffer();
  barrier();
  return isLast;
}

#endif
