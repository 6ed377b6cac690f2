// The follow_* kernels: structs, binding numbers, push constants.
#ifndef RINGLET_LAYOUT_FOLLOW
#define RINGLET_LAYOUT_FOLLOW

#include "layout/hair_points.h"
#include "layout/types.h"

#ifdef __cplusplus
namespace ringlet::layout {
#endif

// Bindings of the follow_* kernels: hairs that follow guides (equations/follow.glsl). Bodies have those of bodies.h,
// with one pose each.
RINGLET_CONSTANT uint kBindGuidePoints = 0;   // vec4[guide particles]: position [m], -1 where the strand is cut
                                              // beyond it, else 0
RINGLET_CONSTANT uint kBindCoreRows = 1;      // CoreRow[guide particles]
RINGLET_CONSTANT uint kBindCoreWeights = 2;   // vec4[records of four weights]
RINGLET_CONSTANT uint kBindCores = 3;         // vec4[guide particles]: the guide's core there [m], 0
RINGLET_CONSTANT uint kBindFollowGuides = 4;  // FollowGuide[guides]
RINGLET_CONSTANT uint kBindCoreFrames = 5;    // vec4[guide particles]: quaternion
RINGLET_CONSTANT uint kBindCurls = 6;         // vec4[guide particles]: from the core, along its frame [m], 0
RINGLET_CONSTANT uint kBindFollowHairs = 7;   // FollowHair[hairs]
RINGLET_CONSTANT uint kBindHairPoints = 8;    // uvec4[points of hairs]: hair_points.h
RINGLET_CONSTANT uint kBindBodySpheres = 9;   // vec4[bodies]: xyz: middle of a sphere about it [m]; w: radius [m]
RINGLET_CONSTANT uint kBindNearCount = 10;    // NearCount
RINGLET_CONSTANT uint kBindNearPoints = 11;   // uint[points near bodies]: the invocation of follow_hairs that found it
RINGLET_CONSTANT uint kBindFollowBlends = 12; // FollowBlend[hairs], where hairs follow several guides
// Whether roots are where FollowHair::rootOffset says, on a scalp that bends, and not where the head carries them.
RINGLET_CONSTANT uint kSpecOnScalp = 2;
RINGLET_CONSTANT uint kSpecCutGuides = 3;  // some guide is cut at some time
// The same as texels, these numbers further:
RINGLET_CONSTANT uint kFollowTexels = 40;

// Constant per guide particle: its core is a weighted sum of particles about it.
struct CoreRow {
  uint firstParticle;  // of the sum
  uint firstRecord;    // of its weights, four to a record; those past the sum's end are 0
  uint recordCount;
  uint beginsPiece;  // 1: it is the first of a piece that is cut off at some time
};

// Constant per guide.
struct FollowGuide {
  vec4 restFrame;  // quaternion: from the core's frame at the root, as it was groomed, to the groom's axes
  uint firstParticle;
  uint particleCount;
  uint unused[2];
};

// Constant per hair: where it stands beside its guide, and how it differs.
struct FollowHair {
  vec3 offset;  // of its root from the guide's, along the guide's restFrame [m]
  uint guide;
  float phase;   // by which the curl is turned about its core [rad]
  float radius;  // of the curl, over the guide's
  float lengthShare;  // of the guide that it follows
  float spread;  // what becomes of the offset beyond the root
  uint firstPoint;
  float rootOffset[3];  // with kSpecOnScalp: in this pose from the guide's root to the hair's [m]
};

// Constant per hair that follows several guides: those beside its own. Nothing of a guide whose share is 0.
struct FollowBlend {
  vec4 offsets[2]; // xyz: of the hair's root from that guide's, along the guide's restFrame [m]; w: share of the core
  uint guides[2];
  uint unused[2];
};

// Points of hairs near bodies, as groups of invocations and as a number.
struct NearCount {
  uint indirect[3];
  uint points;
};

struct FollowParameters {
  vec4 head;      // quaternion: how the head has turned since the rest pose
  uint count;     // of what the kernel has an invocation for
  uint stride;    // invocations a hair: the most particles of any guide
  uint particles; // of all guides
  uint bodyCount; // that hairs stay out of
};

#ifdef __cplusplus
}  // namespace ringlet::layout
#endif
#endif
