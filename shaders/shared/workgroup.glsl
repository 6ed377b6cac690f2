// The size of workgroups, which the host sets. A file that uses gl_WorkGroupSize includes this: if the size
// is declared only further down, compilers silently take it for 1.
#ifndef RINGLET_WORKGROUP
#define RINGLET_WORKGROUP

#include "layout/types.h"

layout(local_size_x_id = kSpecGroupSize) in;

const uint kMostInvocations = 128;  // workgroup size that every device allows

#endif
