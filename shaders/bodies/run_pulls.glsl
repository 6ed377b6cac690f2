// Goals and fields, which are implicit in the velocity systems of the run's particles. Included by
// kernels/strand_step.comp and its integrators.
#ifndef RINGLET_RUN_PULLS
#define RINGLET_RUN_PULLS

#include "bodies/run_fields.glsl"
#include "bodies/run_goals.glsl"
#include "bodies/run_pulled.glsl"
#include "shared/strand_run.glsl"

void feelPulls(uint step) {
  RINGLET_OVER_RUN for (int k = 0; k < runEnd; ++k) pulled[k] = vec4(0);
  if (kGoals && !kGoalShape) feelGoals(step);
  if (kGoals && kGoalShape) feelGoalShape(step);
  if (kFields) feelFields(step);
}

#endif
