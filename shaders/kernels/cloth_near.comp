// The triangles of cloth that each particle may meet in a step, from positions and velocities at its start. Before
// the strand kernel, which looks at no others (shared/cloth_lists.glsl). An invocation for each particle of the
// dispatch's strands, of which none has more than parameters.phases particles. The tree is walked without a stack: from
// node k down to 2 k, or on to the next node beside it or above. Mirrored by clothList of
// reference/equations/cloth_contact.h, which looks at all triangles.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require

#include "shared/strand_buffers.glsl"
#include "shared/bending_buffers.glsl"

const float kListSlack = 2e-3;  // of a way's length: how much too large lineTriangleDistance may be
const float kListRound = 1e-5;  // [m]: the same, for positions are rounded

/// Corners 2 k and 2 k + 1 of the tree's node k, and its longest way.
struct Box {
  vec3 low;
  vec3 high;
  float way;
};
Box boxOf(BodyRest body, uint tree, uint node) {
  vec4 low = clothWord(body, tree + 2 * node);
  return Box(low.xyz, clothWord(body, tree + 2 * node + 1).xyz, low.w);
}
float apartFrom(Box box, vec3 low, vec3 high) { return length(max(max(box.low - high, low - box.high), 0.0)); }

/// Walks on from `node`, 1 at first, to the next leaf that is nearer than `within` to the box from low to high, less
/// the share of its longest way by which it may come nearer. Returns its node; 0: none is left, and `node` is 0. A loop
/// of its own, since a driver that masks lanes would do at every node what is done at a leaf. Carried by the loop, see
/// kDone of body_contact.glsl.
uint nextLeaf(BodyRest body, uint tree, inout uint node, vec3 low, vec3 high, float shares, float within) {
  uint leaves = 1u << body.triangleBits;
  uint leaf = 0;
  do {
    Box box = boxOf(body, tree, max(node, 1));
    bool isNear = node != 0 && apartFrom(box, low, high) - shares * box.way < within;
    bool isLeaf = node >= leaves;
    leaf = isNear && isLeaf ? node : leaf;
    uint beside = node + 1;
    uint after = isNear && !isLeaf ? 2 * node : beside >> findLSB(beside);
    node = node == 0 || after == 1 ? 0 : after;
  } while (leaf == 0 && node != 0);
  return leaf;
}
/// The triangles of a leaf: from x to y, without y; of none none.
uvec2 trianglesOf(BodyRest body, uint leaf) {
  uint at = max(leaf, 1u << body.triangleBits) - (1u << body.triangleBits);
  uint first = firstOfNode(body, at, body.triangleBits);
  return uvec2(first, leaf == 0 ? first : firstOfNode(body, at + 1, body.triangleBits));
}

/// A distance beyond which the walk through the tree need not look: a little more than that of a leaf that is near.
float nearestAtMost(BodyRest body, uint copy, float share, bool moves, vec3 y, float search) {
  uint tree = treeOf(body, copy);
  uint leaves = 1u << body.triangleBits;
  bool isNear = apartFrom(boxOf(body, tree, 1), y, y) < search;
  uint node = isNear ? 1 : leaves;
  if (node < leaves) do {
    bool isSecond = apartFrom(boxOf(body, tree, 2 * node + 1), y, y) < apartFrom(boxOf(body, tree, 2 * node), y, y);
    node = 2 * node + (isSecond ? 1 : 0);
  } while (node < leaves);
  float most = search;
  uvec2 triangles = trianglesOf(body, isNear ? node : 0);
  for (uint triangle = triangles.x; triangle < triangles.y; ++triangle)
    most = min(most, clothSeen(body, copy, share, moves, triangle, y).distance);
  return min(1.001 * most + kListRound, search);
}

/// The nearest place of the cloth, within `search`: xyz: how it moves to the next copy; w: its distance [m].
vec4 nearestTo(BodyRest body, uint copy, float share, vec3 y, float search) {
  uint tree = treeOf(body, copy);
  bool moves = longestWay(body, copy) > 0.0;
  float nearest = nearestAtMost(body, copy, share, moves, y, search);
  vec3 way = vec3(0);
  uint node = 1;
  do {
    uvec2 triangles = trianglesOf(body, nextLeaf(body, tree, node, y, y, 0.0, nearest));
    for (uint triangle = triangles.x; triangle < triangles.y; ++triangle) {
      ClothSeen seen = clothSeen(body, copy, share, moves, triangle, y);
      bool isNearer = seen.distance < nearest;
      way = isNearer ? seen.way : way;
      nearest = isNearer ? seen.distance : nearest;
    }
  } while (node != 0);
  return vec4(way, nearest);
}

/// What of the way from `from` by `along` is beyond the cloth that it goes through first, across that: the rest slides.
vec3 partBeyond(BodyRest body, uint copy, float share, vec3 from, vec3 along) {
  uint tree = treeOf(body, copy);
  bool moves = longestWay(body, copy) > 0.0;
  vec3 low = min(from, from + along);
  vec3 high = max(from, from + along);
  float first = 2.0;
  vec3 beyond = vec3(0);
  uint node = 1;
  do {
    uvec2 triangles = trianglesOf(body, nextLeaf(body, tree, node, low, high, 0.0, kListRound));
    for (uint triangle = triangles.x; triangle < triangles.y; ++triangle) {
      vec3 corners[3] = cornersOf(body, copy, share, moves, triangle);
      float at = crossingShare(from, from + along, corners[0], corners[1], corners[2]);
      bool isFirst = at < first;
      vec3 n = isFirst ? normalize(cross(corners[1] - corners[0], corners[2] - corners[0])) : vec3(0);
      beyond = isFirst ? (1.0 - at) * dot(n, along) * n : beyond;
      first = isFirst ? at : first;
    }
  } while (node != 0);
  return beyond;
}

float bounds[kClothListed];  // how near each comes to the way
uint listed[kClothListed];
uint count;
float worst;  // of the bounds once the list is full; before, how far is looked

/// Takes a triangle into the list, in place of the one furthest away if it is full.
void take(uint triangle, float bound) {
  uint at = count;
  if (count == kClothListed) {
    at = 0;
    [[unroll]] for (uint k = 1; k < kClothListed; ++k) at = bounds[k] > bounds[at] ? k : at;
  }
  bounds[at] = bound;
  listed[at] = triangle;
  count = min(count + 1, kClothListed);
  if (count < kClothListed) return;
  worst = bounds[0];
  [[unroll]] for (uint k = 1; k < kClothListed; ++k) worst = max(worst, bounds[k]);
}

/// Lists the triangles that come nearest to the way from `from` by `along`; way: of the frame in which it is. Returns
/// how far from it all are known, at most `search`.
float listNear(BodyRest body, uint copy, float share, float shares, vec3 from, vec3 along, vec3 way, float search) {
  uint tree = treeOf(body, copy);
  bool moves = longestWay(body, copy) > 0.0;
  vec3 low = min(from, from + along);
  vec3 high = max(from, from + along);
  float slack = kListSlack * length(along) + kListRound;
  float ofFrame = shares * length(way);
  count = 0;
  worst = search;
  uint node = 1;
  do {
    uint leaf = nextLeaf(body, tree, node, low, high, shares, worst + ofFrame + slack);
    uvec2 triangles = trianglesOf(body, leaf);
    for (uint triangle = triangles.x; triangle < triangles.y; ++triangle) {
      vec3 corners[3] = cornersOf(body, copy, share, moves, triangle);
      float faster = 0.0;
      [[unroll]] for (uint k = 0; k < 3; ++k) {
        vec3 on;
        cornerOf(body, copy, moves, triangle, k, on);
        faster = max(faster, shares * length(on - way));
      }
      float bound = lineTriangleDistance(from, from + along, corners[0], corners[1], corners[2]) - faster - slack;
      if (bound < worst) take(triangle, bound);
    }
  } while (node != 0);
  return node == 0 ? worst : 0.0;  // a driver that ends loops early leaves it unknown
}

void listOf(uint cloth, BodyStep body, uint i) {
  uint copy = copyOf(body.before.field);
  float share = body.before.field - float(copy);
  float shares = bendingShare(body);
  vec3 p = positionAtStart(i);
  vec3 from = placeAtStart(body, p);
  vec3 whole = placeAtEnd(body, p + stepSeconds() * velocityAtStart(i)) - from;
  // Cloth further away is not met on that way, nor within kClothReach of it.
  float ofCloth = shares * longestWay(body.rest, copy);
  float within = min(kClothReach + 2.0 * length(whole) + 3.0 * ofCloth + 4.0 * kListRound, kClothSearch);
  vec4 nearest = nearestTo(body.rest, copy, share, from, within);
  vec3 way = nearest.xyz;
  vec3 along = whole - shares * way;
  along -= partBeyond(body.rest, copy, share, from, along);
  // From all that is not nearer than the nearest place; where that is enough, no list is needed.
  float far = nearest.w - (1.0 + kListSlack) * length(along) - kListRound -
              ofCloth - shares * length(way);
  float reach = far;
  count = 0;
  if (far < kClothReach) {
    float search = min(kClothReach + 2.0 * length(along), kClothSearch);
    reach = listNear(body.rest, copy, share, shares, from, along, way, search);
  }
  uint list = cloth * parameters.particleCount + i;
  clothLists[list].from = from;
  clothLists[list].reach = reach;
  clothLists[list].along = along;
  clothLists[list].field = body.before.field;
  clothLists[list].way = way;
  clothLists[list].distance = min(min(nearest.w, kClothReach), max(reach, 0.0));
  clothLists[list].count = count;
  for (uint k = 0; k < count; ++k) clothLists[list].triangles[k] = listed[k];
}

void main() {
  if (kContacts && control.isHalted != 0) return;
  numbers = numbersOfFrame;
  uint mostParticles = parameters.phases;
  uint item = gl_GlobalInvocationID.x;
  uint s = parameters.strandBegin + item / mostParticles;
  if (s >= (parameters.strandEnd & 0x7fffffffu)) return;
  strand = strandRest(s);
  uint k = item % mostParticles;
  if (k >= strand.particleCount || (kFalls && k == 0)) return;
  for (uint b = 0; b < numbers.bodyCount; ++b) {
    BodyStep body = bodyStep(parameters.stepBegin, numbers.bodyCount, b);
    if (body.rest.shape == kShapeCloth) listOf(body.rest.lists[0], body, strand.firstParticle + k);
  }
}
