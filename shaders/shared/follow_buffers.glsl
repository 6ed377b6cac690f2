// The buffers and parameters of the follow_* kernels (layout/follow.h).
#ifndef RINGLET_FOLLOW_BUFFERS
#define RINGLET_FOLLOW_BUFFERS

#include "maths/quaternion.glsl"
#include "layout/follow.h"
#include "shared/texels.glsl"
#include "shared/workgroup.glsl"

layout(constant_id = kSpecOnScalp) const bool kOnScalp = false;
layout(constant_id = kSpecCutGuides) const bool kCutGuides = false;
layout(constant_id = kSpecOwnPoints) const bool kOwnPoints = false;

layout(set = 0, binding = kBindGuidePoints) readonly buffer GuidePoints { vec4 guidePoints[]; };
layout(set = 0, binding = kBindCoreRows) readonly buffer CoreRows { CoreRow coreRows[]; };
layout(set = 0, binding = kBindCoreWeights) readonly buffer CoreWeights { vec4 coreWeights[]; };
layout(set = 0, binding = kBindFollowGuides) readonly buffer FollowGuides { FollowGuide followGuides[]; };
layout(set = 0, binding = kBindFollowHairs) readonly buffer FollowHairs { FollowHair followHairs[]; };
layout(set = 0, binding = kFollowTexels + kBindGuidePoints) uniform usamplerBuffer guidePointTexels;
layout(set = 0, binding = kFollowTexels + kBindCoreRows) uniform usamplerBuffer coreRowTexels;
layout(set = 0, binding = kFollowTexels + kBindCoreWeights) uniform usamplerBuffer coreWeightTexels;
layout(set = 0, binding = kFollowTexels + kBindCores) uniform usamplerBuffer coreTexels;
layout(set = 0, binding = kFollowTexels + kBindFollowGuides) uniform usamplerBuffer followGuideTexels;
layout(set = 0, binding = kFollowTexels + kBindCoreFrames) uniform usamplerBuffer coreFrameTexels;
layout(set = 0, binding = kFollowTexels + kBindCurls) uniform usamplerBuffer curlTexels;
layout(set = 0, binding = kFollowTexels + kBindFollowHairs) uniform usamplerBuffer followHairTexels;
#ifdef RINGLET_BLENDS
layout(set = 0, binding = kBindFollowBlends) readonly buffer FollowBlends { FollowBlend followBlends[]; };
layout(set = 0, binding = kFollowTexels + kBindFollowBlends) uniform usamplerBuffer followBlendTexels;
#endif
layout(push_constant) uniform Parameters { FollowParameters parameters; };

vec3 guidePoint(uint i) { return (kTexels ? vectorAt(guidePointTexels, i) : guidePoints[i]).xyz; }
vec4 coreWeight(uint i) { return kTexels ? vectorAt(coreWeightTexels, i) : coreWeights[i]; }
CoreRow coreRow(uint i) {
  if (!kTexels) return coreRows[i];
  uvec4 row = recordAt(coreRowTexels, i);
  return CoreRow(row.x, row.y, row.z, row.w);
}
bool beginsPiece(uint i) { return kCutGuides && coreRow(i).beginsPiece != 0; }
bool isCutBeyond(uint i) { return (kTexels ? vectorAt(guidePointTexels, i) : guidePoints[i]).w < 0.0; }
FollowGuide followGuide(uint i) {
  if (!kTexels) return followGuides[i];
  uvec4 count = recordAt(followGuideTexels, 2 * i + 1);
  return FollowGuide(vectorAt(followGuideTexels, 2 * i), count.x, count.y, uint[2](count.z, count.w));
}
FollowHair followHair(uint i) {
  if (!kTexels) return followHairs[i];
  uvec4 place = recordAt(followHairTexels, 3 * i);
  vec4 differs = vectorAt(followHairTexels, 3 * i + 1);
  uvec4 points = recordAt(followHairTexels, 3 * i + 2);
  vec3 root = uintBitsToFloat(points.yzw);
  return FollowHair(uintBitsToFloat(place.xyz), place.w, differs.x, differs.y, differs.z, differs.w, points.x,
                    float[3](root.x, root.y, root.z));
}
#ifdef RINGLET_BLENDS
FollowBlend followBlend(uint i) {
  if (!kTexels) return followBlends[i];
  uvec4 guides = recordAt(followBlendTexels, 3 * i + 2);
  return FollowBlend(vec4[2](vectorAt(followBlendTexels, 3 * i), vectorAt(followBlendTexels, 3 * i + 1)),
                     uint[2](guides.x, guides.y), uint[2](guides.z, guides.w));
}
#endif

#endif
