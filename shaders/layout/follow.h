// The follow_* kernels: structs, binding numbers, push constants.
#ifndef RINGLET_LAYOUT_FOLLOW
#define RINGLET_LAYOUT_FOLLOW

#include "layout/hair_points.h"
#include "layout/types.h"

#ifdef __cplusplus
namespace ringlet::layout {
#endif

// Bindings of the follow_* kernels: hairs that follow guides (equations/follow.glsl). Bodies have the
// bindings of bodies.h, with one pose each.
RINGLET_CONSTANT uint kBindGuidePoints = 0;   // vec4[guide particles]: position [m], -1 if the strand is cut
                                              // after it, else 0
RINGLET_CONSTANT uint kBindCoreRows = 1;      // CoreRow[guide particles]
RINGLET_CONSTANT uint kBindCoreWeights = 2;   // vec4[records of four weights]
RINGLET_CONSTANT uint kBindCores = 3;         // vec4[guide particles]: core of the guide [m], 0
RINGLET_CONSTANT uint kBindFollowGuides = 4;  // FollowGuide[guides]
RINGLET_CONSTANT uint kBindCoreFrames = 5;    // vec4[guide particles]: quaternion
RINGLET_CONSTANT uint kBindCurls = 6;         // vec4[guide particles]: offset of the guide from its core,
                                              // along the core's frame [m], 0
RINGLET_CONSTANT uint kBindFollowHairs = 7;   // FollowHair[hairs]
RINGLET_CONSTANT uint kBindHairPoints = 8;    // uvec4[points of hairs]: hair_points.h
RINGLET_CONSTANT uint kBindInsideCount = 9;   // InsideCount
RINGLET_CONSTANT uint kBindInsidePoints = 10; // uint[points inside bodies]: index of the invocation of
                                              // follow_hairs
RINGLET_CONSTANT uint kBindFollowBlends = 11; // FollowBlend[hairs], if hairs follow several guides
RINGLET_CONSTANT uint kBindOwnPoints = 12;    // vec4[points of hairs] with kSpecOwnPoints: shift from the
                                              // guide along the frame beside it [m], position on the guide
                                              // in edges; else vec4[1], unused
// True: roots are at FollowHair::rootOffset, on a deforming scalp; false: the head carries them.
RINGLET_CONSTANT uint kSpecOnScalp = 2;
RINGLET_CONSTANT uint kSpecCutGuides = 3;  // guides may be cut
RINGLET_CONSTANT uint kSpecOwnPoints = 4;  // hairs have points of their own, else those of their guides; then
                                           // one more FollowHair has the firstPoint after the last
// The same as texels, with these added to the binding numbers:
RINGLET_CONSTANT uint kFollowTexels = 40;

// Constant for each guide particle: the weights by which its core is a sum of neighbouring particles.
struct CoreRow {
  uint firstParticle;  // first particle of the sum
  uint firstRecord;    // first record of its weights, four in each; weights beyond the sum's end are 0
  uint recordCount;
  uint beginsPiece;  // 1: the first particle of a piece that may be cut off
};

// Constant for each guide.
struct FollowGuide {
  vec4 restFrame;  // quaternion: from the core's frame at the root, in the rest pose, to the groom's axes
  uint firstParticle;
  uint particleCount;
  uint unused[2];
};

// Constant for each hair: its place beside its guide, and its differences from it.
struct FollowHair {
  vec3 offset;  // of its root from the guide's, along the guide's restFrame [m]
  uint guide;
  float phase;   // angle by which the curl is turned about its core [rad]
  float radius;  // of the curl, relative to the guide's
  float lengthShare;  // length relative to the guide's
  float spread;  // factor on the offset beyond the root
  uint firstPoint;
  float rootOffset[3];  // with kSpecOnScalp: from the guide's root to the hair's, in this pose [m]
};

// Constant for each hair that follows several guides: the guides besides its own. A guide with share 0 is
// unused.
struct FollowBlend {
  vec4 offsets[2]; // xyz: of the hair's root from that guide's, along the guide's restFrame [m]; w: share of the core
  uint guides[2];
  uint unused[2];
};

// The points of hairs inside bodies: their number, also as workgroups.
struct InsideCount {
  uint indirect[3];
  uint points;
};

struct FollowParameters {
  vec4 head;      // quaternion: rotation of the head relative to the rest pose
  uint count;     // number of invocations that have work
  uint stride;    // invocations for each hair: the most points of one
  uint particles; // of all guides
  uint bodyCount; // number of bodies that hairs are kept out of
};

#ifdef __cplusplus
}  // namespace ringlet::layout
#endif
#endif
