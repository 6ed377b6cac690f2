// Lets one workgroup of a dispatch do what follows on the work of all of them, so that this needs no dispatch of its
// own. The buffers of the kernel that includes this have the number of workgroups that have come so far, which is 0
// between dispatches.
#ifndef RINGLET_LAST_GROUP
#define RINGLET_LAST_GROUP

#include "shared/workgroup.glsl"

/// Adds one to that number, and returns what it was; sets it to 0.
uint addFinished();
void clearFinished();

shared bool isLast;

/// Whether all other workgroups of the dispatch have come here. Called once, by all invocations of each. Atomics then
/// see what the others did by atomics before; other reads and writes may not.
bool isLastGroup() {
  memoryBarrierBuffer();
  barrier();
  if (gl_LocalInvocationID.x == 0) {
    isLast = addFinished() + 1 == gl_NumWorkGroups.x;
    if (isLast) clearFinished();
  }
  memoryBarrierBuffer();
  barrier();
  return isLast;
}

#endif
