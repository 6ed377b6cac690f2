// A point of a hair beside its guide, as needed by kernels with an invocation for each point; compiled with
// RINGLET_BLENDS for three guides. Mirrored by reference/follow_guide.h.
#ifndef RINGLET_HAIR_ON_GUIDE
#define RINGLET_HAIR_ON_GUIDE

#include "equations/follow.glsl"
#include "shared/follow_buffers.glsl"

layout(set = 0, binding = kBindCores) readonly buffer Cores { vec4 cores[]; };
layout(set = 0, binding = kBindCoreFrames) readonly buffer CoreFrames { vec4 coreFrames[]; };
layout(set = 0, binding = kBindCurls) readonly buffer Curls { vec4 curls[]; };
layout(set = 0, binding = kBindOwnPoints) readonly buffer OwnPoints { vec4 ownPoints[]; };
layout(set = 0, binding = kFollowTexels + kBindOwnPoints) uniform usamplerBuffer ownPointTexels;

vec4 ownPoint(uint i) { return kTexels ? vectorAt(ownPointTexels, i) : ownPoints[i]; }
uint pointCountOf(uint h, FollowHair hair, FollowGuide guide) {
  return kOwnPoints ? followHair(h + 1).firstPoint - hair.firstPoint : guide.particleCount;
}

GuidePlace placeAt(uint i) {
  if (!kTexels) return GuidePlace(cores[i].xyz, curls[i].xyz, coreFrames[i]);
  return GuidePlace(vectorAt(coreTexels, i).xyz, vectorAt(curlTexels, i).xyz, vectorAt(coreFrameTexels, i));
}
vec3 pointOf(GuidePlace place) { return place.core + rotate(place.frame, place.curl); }

/// The guide beside a point of a hair.
struct GuideBeside {
  GuidePlace before, after;  // the guide's particles before and after the point
  float between;             // position between them, 0 to 1
};
// Position on a guide: between particles `after` - 1 and `after`, 0 to 1.
struct AlongGuide {
  uint after;
  float between;
};
AlongGuide placeAlong(FollowGuide guide, float along) {
  uint k = min(uint(along), guide.particleCount - 2);
  float between = along - float(k);
  if (beginsPiece(guide.firstParticle + k + 1)) between = between < 0.5 ? 0.0 : 1.0;  // no interpolation
                                                                                      // across a cut
  return AlongGuide(k + 1, between);
}
GuideBeside besideOf(FollowGuide guide, float along) {
  AlongGuide place = placeAlong(guide, along);
  uint at = guide.firstParticle + place.after - 1;
  return GuideBeside(placeAt(at), placeAt(at + 1), place.between);
}
GuidePlace placeOf(GuideBeside beside) { return placeBetween(beside.before, beside.after, beside.between); }

struct HairOnGuide {
  FollowHair hair;
  FollowGuide guide;
  vec3 rootOffset;  // from the guide's root to the hair's, in this pose [m]
  float share;      // of the way from root to tip
  float along;      // position on the guide, in edges
  vec3 shift;       // with points of its own, along the frame beside it [m]
  GuideBeside own;
#ifdef RINGLET_BLENDS
  float weights[2];     // of the other guides' cores
  vec3 offsets[2];      // d [m]
  vec3 rootOffsets[2];  // e [m]
  GuideBeside others[2];
#endif
  uint tag;  // of the point
};

#ifdef RINGLET_BLENDS
/// Sets the values of another guide of the hair.
void besideOther(uint k, FollowBlend blend, vec3 root, inout HairOnGuide point) {
  FollowGuide guide = followGuide(blend.guides[k]);
  float along = point.along / float(point.guide.particleCount - 1) * float(guide.particleCount - 1);
  point.weights[k] = blend.offsets[k].w;
  point.offsets[k] = blend.offsets[k].xyz;
  point.rootOffsets[k] = root - guidePoint(guide.firstParticle);
  point.others[k] = besideOf(guide, along);
}
#endif

// Position of point i of a hair on its guide, in edges. Points of a shorter hair lie further back, except at
// the root.
float alongGuide(uint i, FollowHair hair, FollowGuide guide) {
  if (kOwnPoints) return ownPoint(hair.firstPoint + i).w;
  float share = float(i) / float(guide.particleCount - 1);
  return float(i) * (1.0 + (hair.lengthShare - 1.0) * risesOver(0.2, share));
}

// Whether the guide is cut between points i and i + 1 of a hair.
bool isCutAfter(uint i, FollowHair hair, FollowGuide guide) {
  AlongGuide here = placeAlong(guide, alongGuide(i, hair, guide));
  AlongGuide next = placeAlong(guide, alongGuide(i + 1, hair, guide));
  uint at = here.after - (here.between < 1.0 ? 1 : 0);
  uint nextAt = next.after - (next.between < 1.0 ? 1 : 0);
  bool isCut = false;
  for (uint k = at; k < nextAt; ++k) isCut = isCut || isCutBeyond(guide.firstParticle + k);
  return isCut;
}

/// Point i of hair h; i must be below pointCountOf it.
HairOnGuide hairOnGuide(uint h, uint i, FollowHair hair, FollowGuide guide) {
  HairOnGuide point;
  uint last = pointCountOf(h, hair, guide) - 1;
  point.hair = hair;
  point.guide = guide;
  point.along = alongGuide(i, hair, guide);
  point.share = float(i) / float(last);
  point.shift = vec3(0.0);
  if (kOwnPoints) {
    point.share = min(point.along / (hair.lengthShare * float(guide.particleCount - 1)), 1.0);
    point.shift = ownPoint(hair.firstPoint + i).xyz;
  }
  point.rootOffset = kOnScalp ? vec3(hair.rootOffset[0], hair.rootOffset[1], hair.rootOffset[2])
                              : rotate(multiply(parameters.head, guide.restFrame), hair.offset);
  point.own = besideOf(guide, point.along);
  point.tag = i == last || kCutGuides && isCutAfter(i, hair, guide) ? h | kHairEnd : h;
#ifdef RINGLET_BLENDS
  FollowBlend blend = followBlend(h);
  vec3 root = guidePoint(guide.firstParticle) + point.rootOffset;
  besideOther(0, blend, root, point);
  besideOther(1, blend, root, point);
#endif
  return point;
}

/// Its place without bodies [m].
vec3 followed(HairOnGuide point) {
  GuidePlace place = placeOf(point.own);
  vec3 x = followedPoint(point.hair.phase, point.hair.radius, point.hair.spread, point.hair.offset, place,
                         point.rootOffset, point.share);
  if (kOwnPoints) x += rotate(place.frame, point.shift);
#ifdef RINGLET_BLENDS
  vec3 ofOwn = blendedPoint(point.hair.spread, point.hair.offset, place, point.rootOffset, point.share);
  for (uint k = 0; k < 2; ++k) {
    vec3 ofOther = blendedPoint(point.hair.spread, point.offsets[k], placeOf(point.others[k]), point.rootOffsets[k],
                                point.share);
    x += point.weights[k] * (ofOther - ofOwn);
  }
#endif
  return x;
}

#endif
