// What pulls on this lane's particles beside gravity, implicit in their velocity systems: goals, and fields. Included
// by kernels/strand_step.comp.
vec4 pull[RUN];  // xyz: to the right-hand side [mass unit m/s]; w: to the mass [mass unit]

#include "bodies/run_goals.glsl"
#include "bodies/run_fields.glsl"

void feelPulls(uint step) {
  RINGLET_OVER_RUN for (int k = 0; k < RUN; ++k) pull[k] = vec4(0);
  if (kGoals) feelGoals(step);
  if (kFields) feelFields(step);
}
