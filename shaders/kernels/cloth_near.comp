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
/// The node after this one, within it or not; 1: none is left.
uint nodeAfter(uint node, bool within) {
  uint beside = node + 1;
  return within ? 2 * node : beside >> findLSB(beside);
}

/// The nearest place of the cloth, within kClothSearch: xyz: how it moves to the next copy; w: its distance [m].
vec4 nearestTo(BodyRest body, uint copy, float share, vec3 y) {
  uint tree = treeOf(body, copy);
  uint leaves = 1u << body.triangleBits;
  bool moves = longestWay(body, copy) > 0.0;
  float nearest = kClothSearch;
  vec3 way = vec3(0);
  uint node = 1;
  do {
    Box box = boxOf(body, tree, node);
    bool isNear = length(max(max(box.low - y, y - box.high), 0.0)) < nearest;
    bool isLeaf = node >= leaves;
    if (isNear && isLeaf) {
      uint end = firstOfNode(body, node - leaves + 1, body.triangleBits);
      for (uint triangle = firstOfNode(body, node - leaves, body.triangleBits); triangle < end; ++triangle) {
        ClothSeen seen = clothSeen(body, copy, share, moves, triangle, y);
        bool isNearer = seen.distance < nearest;
        way = isNearer ? seen.way : way;
        nearest = isNearer ? seen.distance : nearest;
      }
    }
    node = nodeAfter(node, isNear && !isLeaf);
  } while (node != 1);
  return vec4(way, nearest);
}

/// What of the way from `from` by `along` is beyond the cloth that it goes through first, across that: the rest slides.
vec3 partBeyond(BodyRest body, uint copy, float share, vec3 from, vec3 along) {
  uint tree = treeOf(body, copy);
  uint leaves = 1u << body.triangleBits;
  bool moves = longestWay(body, copy) > 0.0;
  vec3 low = min(from, from + along);
  vec3 high = max(from, from + along);
  float first = 2.0;
  vec3 beyond = vec3(0);
  uint node = 1;
  do {
    Box box = boxOf(body, tree, node);
    bool isNear = all(lessThanEqual(box.low, high)) && all(lessThanEqual(low, box.high));
    bool isLeaf = node >= leaves;
    if (isNear && isLeaf) {
      uint end = firstOfNode(body, node - leaves + 1, body.triangleBits);
      for (uint triangle = firstOfNode(body, node - leaves, body.triangleBits); triangle < end; ++triangle) {
        vec3 corners[3] = cornersOf(body, copy, share, moves, triangle);
        float at = crossingShare(from, from + along, corners[0], corners[1], corners[2]);
        bool isFirst = at < first;
        vec3 n = isFirst ? normalize(cross(corners[1] - corners[0], corners[2] - corners[0])) : vec3(0);
        beyond = isFirst ? (1.0 - at) * dot(n, along) * n : beyond;
        first = isFirst ? at : first;
      }
    }
    node = nodeAfter(node, isNear && !isLeaf);
  } while (node != 1);
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
  uint leaves = 1u << body.triangleBits;
  bool moves = longestWay(body, copy) > 0.0;
  vec3 low = min(from, from + along);
  vec3 high = max(from, from + along);
  float slack = kListSlack * length(along) + kListRound;
  float ofFrame = shares * length(way);
  count = 0;
  worst = search;
  uint node = 1;
  do {
    Box box = boxOf(body, tree, node);
    float apart = length(max(max(box.low - high, low - box.high), 0.0));
    bool isNear = apart - shares * box.way - ofFrame - slack < worst;
    bool isLeaf = node >= leaves;
    if (isNear && isLeaf) {
      uint end = firstOfNode(body, node - leaves + 1, body.triangleBits);
      for (uint triangle = firstOfNode(body, node - leaves, body.triangleBits); triangle < end; ++triangle) {
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
    }
    node = nodeAfter(node, isNear && !isLeaf);
  } while (node != 1);
  return node == 1 ? worst : 0.0;  // a driver that ends loops early leaves it unknown
}

void listOf(uint cloth, BodyStep body, uint i) {
  uint copy = copyOf(body.before.field);
  float share = body.before.field - float(copy);
  float shares = bendingShare(body);
  vec3 p = positionAtStart(i);
  vec3 from = placeAtStart(body, p);
  vec4 nearest = nearestTo(body.rest, copy, share, from);
  vec3 way = nearest.xyz;
  vec3 along = placeAtEnd(body, p + stepSeconds() * velocityAtStart(i)) - from - shares * way;
  along -= partBeyond(body.rest, copy, share, from, along);
  float search = min(max(kClothReach + 2.0 * length(along), nearest.w), kClothSearch);
  float reach = listNear(body.rest, copy, share, shares, from, along, way, search);
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
