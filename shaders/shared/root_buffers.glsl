// The poses that carry the root of `strand` (strand_buffers.glsl, with its index `strandAt`): the head's, and
// the strand's own if strands have some.
#ifndef RINGLET_ROOT_BUFFERS
#define RINGLET_ROOT_BUFFERS

#include "maths/quaternion.glsl"
#include "layout/strands.h"
#include "shared/strand_buffers.glsl"
#include "shared/texels.glsl"

layout(set = 0, binding = kBindRootPoses) readonly buffer RootPoses { RootPose rootPoses[]; };
layout(set = 0, binding = kBindRootPoseTexels) uniform usamplerBuffer rootPoseTexels;

uint rootPoseIndex(uint pose) { return pose * parameters.strandCount + strandAt; }
vec3 rootPosition(uint pose) {
  uint i = rootPoseIndex(pose);
  return kTexels ? vectorAt(rootPoseTexels, 4 * i).xyz : rootPoses[i].position.xyz;
}
vec4 rootRotation(uint pose) {
  uint i = rootPoseIndex(pose);
  return kTexels ? vectorAt(rootPoseTexels, 4 * i + 1) : rootPoses[i].rotation;
}
vec4 rootTurn(uint pose) {
  uint i = rootPoseIndex(pose);
  return kTexels ? vectorAt(rootPoseTexels, 4 * i + 2) : rootPoses[i].turn;
}
vec3 rootVelocity(uint pose) {
  uint i = rootPoseIndex(pose);
  return kTexels ? vectorAt(rootPoseTexels, 4 * i + 3).xyz : rootPoses[i].velocity.xyz;
}

// Fallen hair has its rest state along world axes, as it was when it was cut off.
vec4 rotationAt(uint pose) {
  if (kFalls) return vec4(0, 0, 0, 1);
  if (!kMovingRoots) return stepPose(pose).rotation;
  return rootRotation(pose);
}
// The rotation from the pose before. It is stored, since computed as the difference of two rotations it would
// lose digits.
vec4 turnTo(uint pose) {
  if (!kMovingRoots) return stepPose(pose).turn;
  return rootTurn(pose);
}

vec4 rotationAtStart(uint step) { return rotationAt(step); }
vec4 rotationAtEnd(uint step) { return rotationAt(step + 1); }
vec3 headVelocityChange(uint step) { return inertiaFactor() * stepPose(step + 1).velocityChange; }

/// Velocity at x, a place at the step's start, due to the rotation in this step [m/s].
vec3 turningVelocity(uint step, vec3 x) { return displacement(turnTo(step + 1), x) / stepSeconds(); }
/// The same, due to the rotation in the last step.
vec3 turningVelocityBefore(uint step, vec3 x) { return -displacement(conjugate(turnTo(step)), x) / stepSeconds(); }

// The place of pinned particle k of the strand: the carried place plus the strand's shift.
vec3 rootShift() { return vec3(strand.roots[0].shift, strand.roots[1].shift, strand.roots[2].shift); }
float shiftedShare(uint step) { return stepPose(step).shiftedShare; }
// Relative to the carried origin of the groom.
vec3 pinArm(uint pose, uint k) {
  return rotate(rotationAt(pose), strand.roots[k].pin + shiftedShare(pose) * rootShift());
}
vec3 pinAt(uint pose, uint k) {
  if (!kMovingRoots) return pinArm(pose, k);
  return rootPosition(pose) + pinArm(pose, k);
}
vec3 pinnedVelocity(uint step, uint k) {
  float rate = (shiftedShare(step + 1) - shiftedShare(step)) / stepSeconds();
  vec3 turning = turningVelocity(step, pinArm(step, k)) + rotate(rotationAtEnd(step), rate * rootShift());
  if (!kMovingRoots) return turning;
  return rootVelocity(step + 1) + turning;
}

#endif
