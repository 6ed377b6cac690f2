// Goals of the particles of this lane's run, or of its edges. Included by bodies/run_pulls.glsl.
#ifndef RINGLET_RUN_GOALS
#define RINGLET_RUN_GOALS

#include "bodies/run_pulled.glsl"
#include "equations/goal_spring.glsl"
#include "maths/quaternion.glsl"
#include "shared/strand_run.glsl"

// Goals of edges: they pull on the edge's vector, with the mass of its particle. Uses edges at the step's
// start; the pull is added to their forces.
void feelGoalShape(uint step) {
  float shareBefore = float(step) / float(numbers.stepCount);
  float shareAfter = float(step + 1) / float(numbers.stepCount);
  RINGLET_OVER_RUN for (int k = 0; k < runEnd; ++k) {
    uint i = strand.firstParticle + (isEdge(k) ? first + k : 0);
    vec4 begin = goalAtFrameStart(i);
    vec4 end = goalAtFrameEnd(i);
    vec3 edgeBegin = goalAtFrameStart(i + 1).xyz - begin.xyz;
    vec3 edgeEnd = goalAtFrameEnd(i + 1).xyz - end.xyz;
    vec3 before = mix(edgeBegin, edgeEnd, shareBefore);
    vec3 after = mix(edgeBegin, edgeEnd, shareAfter);
    vec3 move = displacement(turnTo(step + 1), rotate(rotationAtStart(step), before)) +
                rotate(rotationAtEnd(step), after - before);
    vec3 there = rotate(rotationAtEnd(step), after);
    float m = isEdge(k) ? restEdge[k].x : 0.0;
    vec4 onEdge = m * goalPull(end.w, begin.w, e[k], there, move, stepSeconds());
    force[k] -= (1.0 / stepSeconds()) * onEdge.xyz;
    goalAcross[k] = onEdge.w;
  }
}

// Goals of particles. Uses positions at the step's start; places are in the groom's axes and carried as its
// roots are.
void feelGoals(uint step) {
  float shareBefore = float(step) / float(numbers.stepCount);
  float shareAfter = float(step + 1) / float(numbers.stepCount);
  RINGLET_OVER_RUN for (int k = 0; k < runEnd; ++k) {
    uint i = strand.firstParticle + (isParticle(k) ? first + k : 0);
    vec4 begin = goalAtFrameStart(i);
    vec4 end = goalAtFrameEnd(i);
    vec3 before = mix(begin.xyz, end.xyz, shareBefore);
    vec3 after = mix(begin.xyz, end.xyz, shareAfter);
    vec3 carried = rotate(rotationAtStart(step), before);
    vec3 move = displacement(turnTo(step + 1), carried) + rotate(rotationAtEnd(step), after - before);
    vec3 there = rotate(rotationAtEnd(step), after);
    if (kMovingRoots) {
      move += stepSeconds() * rootVelocity(step + 1);
      there += rootPosition(step + 1);
    }
    float m = isParticle(k) ? restEdge[k].x : 0.0;
    pulled[k] += m * goalPull(end.w, begin.w, p[k], there, move, stepSeconds());
  }
}

#endif
