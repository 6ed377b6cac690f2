// How far a place is from a body that may bend, and how the body's surface near the place moves. A body that bends
// has a grid for each of several times of a frame, a copy of its field. Between two times the surface is carried:
// it is where the copy has it, moved on by the way of the triangle nearest to the place. Cloth has no grid, but lists
// of triangles (cloth_lists.glsl). Buffers of strand_step.
// Only kernels compiled with RINGLET_BENDING know bodies that bend: for others nothing is left but the grids.
#ifndef RINGLET_BENDING_BUFFERS
#define RINGLET_BENDING_BUFFERS

#include "shared/body_buffers.glsl"
#include "shared/cloth_lists.glsl"

/// The surface near a place, from a copy of the field to the next.
struct Bending {
  vec3 way;      // of the triangle nearest to the place, its mean [m]
  float spread;  // by which its corners differ from that, at most [m]
  bool isKnown;  // else no triangle is near
  Surface cloth; // of cloth: how far it is from a particle at its start
};
const Bending kStill = Bending(vec3(0), 0.0, false, Surface(0.0, vec3(0)));

#ifdef RINGLET_BENDING
const float kFieldError = 0.25;  // of a look at a field beside the exact distance, at most [cells]

/// What a particle knows of cloth at its own start; an edge as its rootward particle.
Bending clothAtStart(BodyRest body, uint copy) {
  uint list = body.lists[0];
  return Bending(clothLists[list].way, 2.0 * longestWay(body, copy), true,
                 Surface(clothLists[list].distance - body.rounding, vec3(0)));
}
/// Near y; of cloth at the start of the particle that it is about.
Bending bendingNear(BodyRest body, float field, vec3 y) {
  uint copy = copyOf(field);
  if (isCloth(body)) return clothAtStart(body, copy);
  bool isField = body.shape == kShapeField;
  vec3 counts = vec3(body.cells[0], body.cells[1], body.cells[2]);
  uvec3 at = uvec3(clamp(round((y - body.gridOrigin) / body.cell), vec3(0), counts));
  uint row = body.cells[0] + 1;
  uint corner = at.x + row * at.y + row * (body.cells[1] + 1) * at.z;
  uint key = bodyKey(isField ? body.firstKey + copy * cornerCount(body) + corner : 0);
  bool isKnown = isField && key != 0;
  uint last = (1u << body.triangleBits) - 1;
  vec4 way = bodyWay(isKnown ? body.firstWay + copy * body.triangleCount + last - (key & last) : 0);
  return Bending(isKnown ? way.xyz : vec3(0), isKnown ? way.w : 0.0, isKnown, Surface(0.0, vec3(0)));
}

/// Distance and normal at y, in the frame of what carries the body; bending: of the same field and place. Of cloth its
/// distance alone, at the start of the particle.
Surface surfaceAt(BodyRest body, float field, vec3 y, Bending bending) {
  if (isCloth(body)) return bending.cloth;
  uint copy = copyOf(field);
  BodyRest then = body;
  then.firstPair += copy * cornerCount(body);
  return bodyDistance(then, y - (field - float(copy)) * bending.way);
}
Surface surfaceAt(BodyRest body, float field, vec3 y) {
  if (isCloth(body)) {
    ClothPlace place = nearestOfCloth(body, field, y);
    return Surface(place.distance - body.rounding, place.normal);
  }
  return surfaceAt(body, field, y, bendingNear(body, field, y));
}

Bending bendingAtStart(BodyStep body, vec3 y) { return bendingNear(body.rest, body.before.field, y); }
/// By how much the surface near a place moves in the step, seen from what carries the body [m].
float bendingShare(BodyStep body) { return body.after.field - body.before.field; }
vec3 bent(BodyStep body, Bending bending) { return bendingShare(body) * bending.way; }
vec3 bent(BodyStep body, vec3 y) { return bent(body, bendingAtStart(body, y)); }
/// The same for a path from y0 to y1: of the surface near its start, or else near its end.
vec3 bentOnPath(BodyStep body, vec3 y0, vec3 y1) {
  Bending atStart = bendingAtStart(body, y0);
  Bending atEnd = bendingAtStart(body, y1);
  return atStart.isKnown ? bent(body, atStart) : bent(body, atEnd);
}
/// What a look must leave beside the way of a place, for the surface beside it moves otherwise [m].
float bendingRoom(BodyStep body, Bending bending) {
  float error = body.rest.shape == kShapeField ? kFieldError * body.rest.cell : 0.0;
  return bendingShare(body) * bending.spread + error;
}
/// Velocity of the surface near p, a place at the step's start [m/s].
vec3 surfaceVelocityAt(BodyStep body, vec3 p, Bending bending, float T) {
  return bodyVelocityAt(body, p, T) + rotate(body.after.rotation, bent(body, bending)) / T;
}
#else
Surface surfaceAt(BodyRest body, float field, vec3 y, Bending bending) { return bodyDistance(body, y); }
Surface surfaceAt(BodyRest body, float field, vec3 y) { return bodyDistance(body, y); }
Bending bendingAtStart(BodyStep body, vec3 y) { return kStill; }
vec3 bent(BodyStep body, Bending bending) { return vec3(0); }
vec3 bent(BodyStep body, vec3 y) { return vec3(0); }
vec3 bentOnPath(BodyStep body, vec3 y0, vec3 y1) { return vec3(0); }
float bendingRoom(BodyStep body, Bending bending) { return 0.0; }
vec3 surfaceVelocityAt(BodyStep body, vec3 p, Bending bending, float T) { return bodyVelocityAt(body, p, T); }
#endif

#endif
