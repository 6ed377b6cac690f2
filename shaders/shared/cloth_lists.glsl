// What a particle, or the two ends of an edge, know of cloth: the triangles of their lists, which cloth_near.comp has
// made at the step's start. Mirrored by reference/equations/cloth_contact.h.
#ifndef RINGLET_CLOTH_LISTS
#define RINGLET_CLOTH_LISTS

#include "shared/cloth_tree.glsl"

#ifdef RINGLET_BENDING
layout(set = 0, binding = kBindClothLists) buffer ClothLists { ClothList clothLists[]; };

uint clothTurns = 0;  // spent by this lane

/// How many triangles of a list are looked at, which are counted: none where too many have been.
uint takenOf(uint list) {
  uint count = clothTurns < kClothTurns ? clothLists[list].count : 0;
  clothTurns += count + 1;
  return count;
}

/// The list of particle i of the chunk, of cloth as it is in the buffer.
uint clothListOf(BodyRest body, uint i, uint particleCount) {
  return body.lists[0] * particleCount + min(i, particleCount - 1);
}

/// How far all triangles that are not listed are from a place, at least [m].
float reachFrom(uint list, vec3 y, float field) {
  vec3 way = (field - clothLists[list].field) * clothLists[list].way;
  return clothLists[list].reach - length(wayFromLine(y - way - clothLists[list].from, clothLists[list].along));
}

/// What is near a place.
struct ClothPlace {
  bool found;
  float distance;  // from the nearest place of a triangle [m]
  vec3 normal;     // from there
  vec3 way;        // how far that place moves to the next copy [m]
};
ClothPlace nearestOfCloth(BodyRest body, float field, vec3 y) {
  float reach = reachFrom(body.lists[0], y, field);
  float other = reachFrom(body.lists[1], y, field);
  uint list = body.lists[other > reach ? 1 : 0];
  ClothPlace nearest = ClothPlace(false, clamp(max(reach, other), 0.0, kClothReach), vec3(0), vec3(0));
  uint copy = copyOf(field);
  bool moves = longestWay(body, copy) > 0.0;
  uint count = takenOf(list);
  for (uint k = 0; k < count; ++k) {
    ClothSeen seen = clothSeen(body, copy, field - float(copy), moves, clothLists[list].triangles[k], y);
    bool isNearer = seen.distance < nearest.distance;
    nearest.found = nearest.found || isNearer;
    nearest.normal = isNearer ? seen.normal : nearest.normal;
    nearest.way = isNearer ? seen.way : nearest.way;
    nearest.distance = isNearer ? seen.distance : nearest.distance;
  }
  return nearest;
}
#endif

#endif
