// What pulls on the run's particles beside gravity has to add to their velocity systems; goals and fields sum it up.
#ifndef RINGLET_RUN_PULLED
#define RINGLET_RUN_PULLED

#include "scan/lanes.glsl"

vec4 pulled[RUN];       // xyz: to the right-hand side [mass unit m/s]; w: to the mass [mass unit]
float goalAcross[RUN];  // to the edge's matrix, where goals are of edges [mass unit]

#endif
