// Every point of every hair that follows a guide: an invocation for each point, with as many for each hair as
// the one with the most points has. Compiled with RINGLET_AMONG_BODIES it also lists points inside bodies,
// for follow_bodies.comp. Mirrored by reference/follow_guide.h.
#version 450
#extension GL_GOOGLE_include_directive : require
#ifdef RINGLET_AMONG_BODIES
#include "shared/body_buffers.glsl"
#endif
#include "shared/hair_on_guide.glsl"

layout(set = 0, binding = kBindHairPoints) writeonly buffer HairPoints { uvec4 hairPoints[]; };

#ifdef RINGLET_AMONG_BODIES
layout(set = 0, binding = kBindInsideCount) buffer Counts { InsideCount counts; };
layout(set = 0, binding = kBindInsidePoints) writeonly buffer InsidePoints { uint insidePoints[]; };

bool isInsideBodies(vec3 x) {
  bool isInside = false;
  for (uint b = 0; b < parameters.bodyCount; ++b)
    isInside = isInside || distanceFrom(bodyRest(b), bodyPose(b), x) < 0.0;
  return isInside;
}
#endif

void main() {
  uint h = gl_GlobalInvocationID.x / parameters.stride;
  uint i = gl_GlobalInvocationID.x - h * parameters.stride;
  if (h >= parameters.count) return;
  FollowHair hair = followHair(h);
  FollowGuide guide = followGuide(hair.guide);
  if (i >= pointCountOf(h, hair, guide)) return;
  HairOnGuide point = hairOnGuide(h, i, hair, guide);
  vec3 x = followed(point);
  hairPoints[hair.firstPoint + i] = uvec4(floatBitsToUint(x), point.tag);
#ifdef RINGLET_AMONG_BODIES
  if (isInsideBodies(x)) {
    uint k = atomicAdd(counts.points, 1);
    if (k % gl_WorkGroupSize.x == 0) atomicAdd(counts.indirect[0], 1);
    insidePoints[k] = gl_GlobalInvocationID.x;
  }
#endif
}
