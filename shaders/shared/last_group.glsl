// Lets one workgroup of a dispatch continue with the results of all of them, which saves another dispatch.
// The buffers of the kernel that includes this hold the number of workgroups that are done, which is 0
// between dispatches.
#ifndef RINGLET_LAST_GROUP
#define RINGLET_LAST_GROUP

#include "shared/workgroup.glsl"

/// Adds one to that number and returns its old value; sets it to 0.
uint addFinished();
void clearFinished();

shared bool isLast;

/// Whether all other workgroups of the dispatch have come here. Call it once, with all invocations of each.
/// Afterwards atomics see what the others did by atomics; other reads and writes may not.
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
