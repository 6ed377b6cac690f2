// The triangles of cloth, in a tree of boxes (layout/mesh_fields.h), and how one is seen from a place.
// Mirrored by reference/equations/cloth_contact.h.
#ifndef RINGLET_CLOTH_TREE
#define RINGLET_CLOTH_TREE

#include "equations/triangle_distance.glsl"
#include "layout/mesh_fields.h"
#include "shared/body_fields.glsl"

#ifdef RINGLET_BENDING
const float kClothReach = 0.02;  // [m]: cloth further away has no place near a particle
const float kClothSearch = 0.1;  // [m]: triangles further from a particle's way are in no list
const float kOneSide = 0.5;      // square of the sum of two normals that are of one side
const float kThrough = 1e-4;     // [m]: nearer, an edge between two sides goes through
const float kOnCloth = 1e-5;     // [m]: nearer to a triangle, its own normal counts: that of the way is all rounding

uint firstOfNode(BodyRest body, uint at, uint level) {
  uint below = body.triangleCount & ((1u << level) - 1);
  return at * (body.triangleCount >> level) + (at * below >> level);
}
/// The first word of a copy of its tree.
uint treeOf(BodyRest body, uint copy) {
  return body.firstWay + copy * ((4u << body.triangleBits) + 3 * body.triangleCount);
}
vec4 clothWord(BodyRest body, uint i) { return bodyWay(isCloth(body) ? i : 0); }
/// Of all its points from a copy to the next [m]; of the last copy 0, for its next is not there.
float longestWay(BodyRest body, uint copy) { return clothWord(body, treeOf(body, copy) + 2).w; }

/// Corner k of a triangle in a copy [m]; way: from there to the next copy [m]. moves: whether there is a next.
vec3 cornerOf(BodyRest body, uint copy, bool moves, uint triangle, uint k, out vec3 way) {
  uint corner = (4u << body.triangleBits) + 3 * triangle + k;
  vec3 now = clothWord(body, treeOf(body, copy) + corner).xyz;
  way = moves ? clothWord(body, treeOf(body, copy + 1) + corner).xyz - now : vec3(0);
  return now;
}

/// Corners of a triangle at a share of the way to the next copy [m].
vec3[3] cornersOf(BodyRest body, uint copy, float share, bool moves, uint triangle) {
  vec3 corners[3];
  for (uint k = 0; k < 3; ++k) {
    vec3 way;
    corners[k] = cornerOf(body, copy, moves, triangle, k, way);
    corners[k] += share * way;
  }
  return corners;
}

/// A triangle at a share of the way from a copy to the next, seen from a place.
struct ClothSeen {
  float distance;
  vec3 normal;
  vec3 way;       // of its nearest place [m]
  float fastest;  // of its corners along the normal [m]
  float slope;    // by which ways along the normal differ from place to place [1]
};
ClothSeen clothSeen(BodyRest body, uint copy, float share, bool moves, uint triangle, vec3 y) {
  vec3 wayA;
  vec3 wayB;
  vec3 wayC;
  vec3 a = cornerOf(body, copy, moves, triangle, 0, wayA);
  vec3 b = cornerOf(body, copy, moves, triangle, 1, wayB);
  vec3 c = cornerOf(body, copy, moves, triangle, 2, wayC);
  a += share * wayA;
  b += share * wayB;
  c += share * wayC;
  vec3 shares = nearestShares(y, a, b, c);
  vec3 ab = b - a;
  vec3 ac = c - a;
  vec3 apart = y - (shares.x * a + shares.y * b + shares.z * c);
  vec3 across = cross(ab, ac);
  float distance = length(apart);
  float size = length(across);
  vec3 own = size > 0.0 ? across / size : vec3(0, 1, 0);
  vec3 n = distance > kOnCloth ? apart / distance : dot(apart, own) < 0.0 ? -own : own;
  float ofA = dot(n, wayA);
  float ofB = dot(n, wayB) - ofA;
  float ofC = dot(n, wayC) - ofA;
  float bb = dot(ab, ab);
  float cc = dot(ac, ac);
  float bc = dot(ab, ac);
  float square = cc * ofB * ofB - 2.0 * bc * ofB * ofC + bb * ofC * ofC;
  return ClothSeen(distance, n, shares.x * wayA + shares.y * wayB + shares.z * wayC, ofA + max(0.0, max(ofB, ofC)),
                   sqrt(max(square, 0.0) / max(bb * cc - bc * bc, 1e-30)));
}
#endif

#endif
