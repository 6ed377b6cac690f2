// Sums of the terms that goals and fields add to the velocity systems of the run's particles.
#ifndef RINGLET_RUN_PULLED
#define RINGLET_RUN_PULLED

#include "scan/lanes.glsl"

vec4 pulled[RUN];       // xyz: added to the right-hand side [mass unit m/s]; w: to the mass [mass unit]
float goalAcross[RUN];  // added to the edge's matrix, for goals of edges [mass unit]

#endif
