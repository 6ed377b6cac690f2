// Measures the largest distance that a contact particle has moved since the lists were made, and the largest
// speed; from these the last workgroup decides whether the lists are still valid. Also makes the guess from
// which the solve starts (warm start): contacts change little from step to step, so this step is expected to
// change v^0 by most of what the last one did. Reads positions, v^0 and the velocities at the end of the last
// step; writes the control and the guesses. If strands are divided among devices, those of this device are
// measured before the others are known, in a dispatch that decides nothing. Mirrored by
// reference/kernels/contact_step.h.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/contact_buffers.glsl"
#include "shared/contact_decision.glsl"
#include "shared/last_group.glsl"

// The maximum does not depend on the order of invocations.
void enter(uint place, uint group) {
  uint groups = grid[place];
  if (groups == group + 1 || groups == kSeveralGroups) return;
  if (groups == 0) groups = atomicCompSwap(grid[place], 0, group + 1);
  if (hasOthers(groups, group)) atomicMax(grid[place], kSeveralGroups);
}

// Largest values over this invocation's particles. NaN counts as large.
float motion = 0.0;
float speed = 0.0;
float larger(float a, float b) { return max(a, b < 1e30 ? b : 1e30); }

void measure(uint c) {
  ContactRest rest = contactOf(c);
  if (kDivided && parameters.whose != kOfAll && isElsewhere(rest.strand) != (parameters.whose == kOfElsewhere)) return;
  uint particle = rest.particle;
  vec3 x = positionOf(particle);
  vec3 v = velocityOf(particle);
  motion = larger(motion, length(x - listedPosition(c)) + numbers.seconds * length(v - listedVelocity(c)));
  speed = larger(speed, length(v));
  vec3 change = now.steps > 0 ? lastVelocityOf(particle) - predictedBefore(c) : vec3(0);
  histories[c].predicted[now.parity ^ 1] = vec4(v, 0);
  guesses[particle] = vec4(v + numbers.warmth * change, rest.radius);
  if (kInGroups) {
    uint group = groupOf(rest.strand);
    ivec3 cell = cellOf(x);
    enter(cellGroups(bucketOf(cell)), group);
    enter(regionGroups(bucketOf(cell >> 1)), group);
  }
}

void measureAll() {
  if (now.isHalted) return;
  uint invocations = gl_NumWorkGroups.x * gl_WorkGroupSize.x;
  for (uint c = gl_GlobalInvocationID.x; c < numbers.contactCount; c += invocations) measure(c);
  // The bits of numbers >= 0 have the same order as the numbers. Most values are below the maximum so far,
  // and a read costs less than an atomic.
  if (floatBitsToUint(motion) > control.motion) atomicMax(control.motion, floatBitsToUint(motion));
  if (floatBitsToUint(speed) > control.speed) atomicMax(control.speed, floatBitsToUint(speed));
}

void main() {
  readControl();
  measureAll();
  if (kDivided && parameters.whose == kOfHere) return;
  if (isLastGroup() && gl_LocalInvocationID.x == 0) decideLists();
}
