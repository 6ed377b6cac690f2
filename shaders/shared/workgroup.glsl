// The size of workgroups, which the host decides. What names gl_WorkGroupSize includes this: where the size is declared
// further down, compilers take 1 for it without a word.
#ifndef RINGLET_WORKGROUP
#define RINGLET_WORKGROUP

#include "layout/types.h"

layout(local_size_x_id = kSpecGroupSize) in;

#endif
