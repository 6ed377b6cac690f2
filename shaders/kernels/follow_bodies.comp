// Pushes points of hairs out of bodies; follow_hairs.comp lists those inside bodies, in any order. Mirrored by
// reference/follow_guide.h.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/body_buffers.glsl"
#include "shared/hair_on_guide.glsl"

layout(set = 0, binding = kBindHairPoints) writeonly buffer HairPoints { uvec4 hairPoints[]; };
layout(set = 0, binding = kBindInsideCount) readonly buffer Counts { InsideCount counts; };
layout(set = 0, binding = kBindInsidePoints) readonly buffer InsidePoints { uint insidePoints[]; };

const int kRoundsOutOfGrid = 3;  // from far inside, distances in a grid lead out of it roughly

float distanceBeside(BodyRest body, BodyPose pose, GuideBeside beside) {
  return mix(distanceFrom(body, pose, pointOf(beside.before)), distanceFrom(body, pose, pointOf(beside.after)),
             beside.between);
}

void main() {
  if (gl_GlobalInvocationID.x >= counts.points) return;
  uint id = insidePoints[gl_GlobalInvocationID.x];
  uint h = id / parameters.stride;
  uint i = id - h * parameters.stride;
  FollowHair hair = followHair(h);
  FollowGuide guide = followGuide(hair.guide);
  HairOnGuide point = hairOnGuide(h, i, hair, guide);
  vec3 root = pointOf(placeAt(guide.firstParticle)) + point.rootOffset;
  vec3 x = followed(point);
  for (uint b = 0; b < parameters.bodyCount; ++b) {
    BodyRest body = bodyRest(b);
    BodyPose pose = bodyPose(b);
    float ofGuide = distanceBeside(body, pose, point.own);
#ifdef RINGLET_BLENDS
    float ofOwn = ofGuide;
    for (uint k = 0; k < 2; ++k)
      ofGuide += point.weights[k] * (distanceBeside(body, pose, point.others[k]) - ofOwn);
#endif
    float kept = keptBesideGuide(ofGuide, distanceFrom(body, pose, root), point.share);
    int rounds = body.shape < kShapeGrid ? 1 : kRoundsOutOfGrid;
    for (int round = 0; round < rounds; ++round) {
      Surface there = bodyDistance(body, rotate(conjugate(pose.rotation), x - pose.position));
      x += max(kept - there.distance, 0.0) * rotate(pose.rotation, there.normal);
    }
  }
  hairPoints[hair.firstPoint + i] = uvec4(floatBitsToUint(x), point.tag);
}
