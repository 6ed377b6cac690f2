// Buffers of the bodies that hair collides with, and the distance of a place from a body. Part of
// strand_buffers.glsl.
#ifndef RINGLET_BODY_BUFFERS
#define RINGLET_BODY_BUFFERS

#include "equations/body_distance.glsl"
#include "maths/quaternion.glsl"
#include "layout/bodies.h"
#include "shared/texels.glsl"

layout(set = 0, binding = kBindBodies) readonly buffer Bodies { BodyRest bodies[]; };
layout(set = 0, binding = kBindBodyPoses) readonly buffer BodyPoses { BodyPose bodyPoses[]; };
layout(set = 0, binding = kBindGridPairs) readonly buffer GridPairs { uint gridPairs[]; };
layout(set = 0, binding = kBindBodyTexels) uniform usamplerBuffer bodyTexels;
layout(set = 0, binding = kBindBodyPoseTexels) uniform usamplerBuffer bodyPoseTexels;
layout(set = 0, binding = kBindGridPairTexels) uniform usamplerBuffer gridPairTexels;

BodyRest bodyRest(uint b) {
  if (!kTexels) return bodies[b];
  uvec4 grid = recordAt(bodyTexels, 6 * b + 3);
  uvec4 form = recordAt(bodyTexels, 6 * b + 4);
  uvec4 field = recordAt(bodyTexels, 6 * b + 5);
  vec4 box = vectorAt(bodyTexels, 6 * b);
  vec4 origin = vectorAt(bodyTexels, 6 * b + 2);
  return BodyRest(box.xyz, box.w, vectorAt(bodyTexels, 6 * b + 1), origin.xyz, origin.w,
                  uint[3](grid.x, grid.y, grid.z), grid.w, uintBitsToFloat(form.x), form.y, form.z, form.w, field.x,
                  field.y, uint[2](field.z, 0));
}
vec4 bodyBounds(uint b) { return kTexels ? vectorAt(bodyTexels, 6 * b + 1) : bodies[b].bounds; }
BodyPose bodyPose(uint i) {
  if (!kTexels) return bodyPoses[i];
  vec4 place = vectorAt(bodyPoseTexels, 4 * i);
  vec4 moving = vectorAt(bodyPoseTexels, 4 * i + 3);
  return BodyPose(place.xyz, place.w, vectorAt(bodyPoseTexels, 4 * i + 1), vectorAt(bodyPoseTexels, 4 * i + 2),
                  moving.xyz, moving.w);
}

uint gridPair(uint i) { return kTexels ? recordAt(gridPairTexels, i >> 2)[i & 3u] : gridPairs[i]; }

/// Distance and normal at y, in the body's frame; of a body that bends, in the copy of its field that firstPair
/// says.
Surface bodyDistance(BodyRest body, vec3 y) {
  if (body.shape < kShapeGrid) return solidDistance(body.shape, body.halfExtents, body.rounding, y);
  vec3 counts = vec3(body.cells[0], body.cells[1], body.cells[2]);
  vec3 wanted = (y - body.gridOrigin) / body.cell;
  vec3 nearest = clamp(wanted, vec3(0), counts);
  vec3 base = min(floor(nearest), counts - 1.0);
  uvec3 at = uvec3(base);
  uint row = body.cells[0] + 1;
  uint layer = row * (body.cells[1] + 1);
  uint corner = body.firstPair + at.x + row * at.y + layer * at.z;
  uvec4 corners = uvec4(gridPair(corner), gridPair(corner + row), gridPair(corner + layer),
                        gridPair(corner + row + layer));
  Surface surface = gridDistance(corners, nearest - base, wanted - nearest, body.cell);
  surface.distance -= body.rounding;
  return surface;
}

/// Of a body in a pose, from its surface to p [m].
float distanceFrom(BodyRest body, BodyPose pose, vec3 p) {
  return bodyDistance(body, rotate(conjugate(pose.rotation), p - pose.position)).distance;
}

// A body during a step, and transforms between its frame and the strand's.
struct BodyStep {
  BodyRest rest;
  BodyPose before;  // at the step's start
  BodyPose after;
};
BodyStep bodyStep(uint step, uint bodyCount, uint b) {
  return BodyStep(bodyRest(b), bodyPose(step * bodyCount + b), bodyPose((step + 1) * bodyCount + b));
}
vec3 placeAtStart(BodyStep body, vec3 p) {
  return rotate(conjugate(body.before.rotation), p - body.before.position);
}
vec3 placeAtEnd(BodyStep body, vec3 p) { return rotate(conjugate(body.after.rotation), p - body.after.position); }
vec3 outOfBody(BodyStep body, vec3 y) { return rotate(body.after.rotation, y) + body.after.position; }
vec3 outward(BodyStep body, vec3 normal) { return rotate(body.after.rotation, normal); }
/// Velocity of the body's point that is at p at the step's start [m/s].
vec3 bodyVelocityAt(BodyStep body, vec3 p, float T) {
  return body.after.velocity + displacement(body.after.turn, p - body.before.position) / T;
}

#endif
