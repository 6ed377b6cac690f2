// Every point of every hair that follows a guide. An invocation a point, as many a hair as the longest guide has
// particles. Mirrored by reference/follow_guide.h.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "equations/follow.glsl"
#include "shared/follow_buffers.glsl"

layout(set = 0, binding = kBindCores) readonly buffer Cores { vec4 cores[]; };
layout(set = 0, binding = kBindCoreFrames) readonly buffer CoreFrames { vec4 coreFrames[]; };
layout(set = 0, binding = kBindCurls) readonly buffer Curls { vec4 curls[]; };
layout(set = 0, binding = kBindHairPoints) writeonly buffer HairPoints { uvec4 hairPoints[]; };

GuidePlace placeAt(uint i) {
  if (!kTexels) return GuidePlace(cores[i].xyz, curls[i].xyz, coreFrames[i]);
  return GuidePlace(vectorAt(coreTexels, i).xyz, vectorAt(curlTexels, i).xyz, vectorAt(coreFrameTexels, i));
}

void main() {
  uint h = gl_GlobalInvocationID.x / parameters.stride;
  uint i = gl_GlobalInvocationID.x - h * parameters.stride;
  if (h >= parameters.count) return;
  FollowHair hair = followHair(h);
  FollowGuide guide = followGuide(hair.guide);
  if (i >= guide.particleCount) return;

  uint last = guide.particleCount - 1;
  float share = float(i) / float(last);
  // A shorter hair lags behind its guide, but for the root.
  float along = float(i) * (1.0 + (hair.lengthShare - 1.0) * risesOver(0.2, share));
  uint k = min(uint(along), last - 1);
  uint at = guide.firstParticle + k;
  GuidePlace place = placeBetween(placeAt(at), placeAt(at + 1), along - float(k));
  vec3 x = followedPoint(hair.phase, hair.radius, hair.spread, hair.offset, place,
                         multiply(parameters.head, guide.restFrame), share);
  hairPoints[hair.firstPoint + i] = uvec4(floatBitsToUint(x), i == last ? h | kHairEnd : h);
}
