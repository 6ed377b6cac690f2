// Finds the bodies that a run may meet in a step, by their bounding spheres and the distances that both move.
#ifndef RINGLET_NEAR_BODIES
#define RINGLET_NEAR_BODIES

#include "shared/body_buffers.glsl"

/// A box around all places of some particles in a step.
struct Room {
  vec3 low;
  vec3 high;
};
Room emptyRoom() { return Room(vec3(1e30), vec3(-1e30)); }
void include(inout Room room, vec3 p) {
  room.low = min(room.low, p);
  room.high = max(room.high, p);
}

/// The first body from b on that is within `reach` of the room; bodyCount if there is none.
uint nextNear(Room room, float reach, uint step, uint bodyCount, uint b) {
  vec3 middle = 0.5 * (room.low + room.high);
  float radius = 0.5 * length(room.high - room.low) + reach;
  bool isNear = room.low.x > room.high.x;  // nothing in it: done
  if (isNear) return bodyCount;
  if (b < bodyCount) do {
    vec4 bounds = bodyBounds(b);
    BodyPose before = bodyPose(step * bodyCount + b);
    float moves = kTexels ? vectorAt(bodyPoseTexels, 4 * ((step + 1) * bodyCount + b)).w
                          : bodyPoses[(step + 1) * bodyCount + b].moves;
    vec3 there = before.position + rotate(before.rotation, bounds.xyz);
    isNear = length(there - middle) <= radius + bounds.w + moves;
    if (!isNear) ++b;
  } while (b < bodyCount && !isNear);
  return b;
}

#endif
