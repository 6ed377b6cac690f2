// A point of a hair beside its guide, as kernels of a point an invocation find it. Mirrored by
// reference/follow_guide.h.
#ifndef RINGLET_HAIR_ON_GUIDE
#define RINGLET_HAIR_ON_GUIDE

#include "equations/follow.glsl"
#include "shared/follow_buffers.glsl"

layout(set = 0, binding = kBindCores) readonly buffer Cores { vec4 cores[]; };
layout(set = 0, binding = kBindCoreFrames) readonly buffer CoreFrames { vec4 coreFrames[]; };
layout(set = 0, binding = kBindCurls) readonly buffer Curls { vec4 curls[]; };

GuidePlace placeAt(uint i) {
  if (!kTexels) return GuidePlace(cores[i].xyz, curls[i].xyz, coreFrames[i]);
  return GuidePlace(vectorAt(coreTexels, i).xyz, vectorAt(curlTexels, i).xyz, vectorAt(coreFrameTexels, i));
}
vec3 pointOf(GuidePlace place) { return place.core + rotate(place.frame, place.curl); }

struct HairOnGuide {
  FollowHair hair;
  FollowGuide guide;
  vec3 rootOffset;           // in this pose from the guide's root to the hair's [m]
  float share;               // of the way from root to tip
  GuidePlace before, after;  // the guide's particles beside the point,
  float between;             // and where between them it is
  uint tag;                  // of the point
};

// Where on its guide a hair's point is: behind particle `after` - 1, and how far of the way to `after`.
struct AlongGuide {
  uint after;
  float between;
};
AlongGuide alongGuide(uint i, FollowHair hair, FollowGuide guide) {
  uint last = guide.particleCount - 1;
  // A shorter hair lags behind its guide, but for the root.
  float along = float(i) * (1.0 + (hair.lengthShare - 1.0) * risesOver(0.2, float(i) / float(last)));
  uint k = min(uint(along), last - 1);
  float between = along - float(k);
  if (beginsPiece(guide.firstParticle + k + 1)) between = between < 0.5 ? 0.0 : 1.0;  // beside a cut
  return AlongGuide(k + 1, between);
}

// Whether the guide is cut between points i and i + 1 of a hair, which are at most a particle apart.
bool isCutAfter(uint i, AlongGuide here, FollowHair hair, FollowGuide guide) {
  AlongGuide next = alongGuide(i + 1, hair, guide);
  uint at = here.after - (here.between < 1.0 ? 1 : 0);
  uint nextAt = next.after - (next.between < 1.0 ? 1 : 0);
  return at < nextAt && isCutBeyond(guide.firstParticle + nextAt - 1);
}

/// Point i of hair h, where i is below the guide's particleCount.
HairOnGuide hairOnGuide(uint h, uint i, FollowHair hair, FollowGuide guide) {
  uint last = guide.particleCount - 1;
  float share = float(i) / float(last);
  AlongGuide along = alongGuide(i, hair, guide);
  uint at = guide.firstParticle + along.after - 1;
  bool isEnd = i == last || kCutGuides && isCutAfter(i, along, hair, guide);
  vec3 rootOffset = kOnScalp ? vec3(hair.rootOffset[0], hair.rootOffset[1], hair.rootOffset[2])
                             : rotate(multiply(parameters.head, guide.restFrame), hair.offset);
  return HairOnGuide(hair, guide, rootOffset, share, placeAt(at), placeAt(at + 1), along.between,
                     isEnd ? h | kHairEnd : h);
}

/// Where it is, were there no bodies [m].
vec3 followed(HairOnGuide point) {
  return followedPoint(point.hair.phase, point.hair.radius, point.hair.spread, point.hair.offset,
                       placeBetween(point.before, point.after, point.between), point.rootOffset, point.share);
}

#endif
