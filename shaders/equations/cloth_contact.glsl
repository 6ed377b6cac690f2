// Where a particle meets cloth, and how it is kept off. Mirrored by reference/equations/cloth_contact.h, which has a
// sketch and the reasons.
#ifndef RINGLET_CLOTH_CONTACT
#define RINGLET_CLOTH_CONTACT

#include "shared/bending_buffers.glsl"
#include "shared/kept_out.glsl"

#ifdef RINGLET_BENDING
const float kSlip = 1e-6;      // [m] in what is left of a step: what approaches by less slides
const int kClothRounds = 8;    // slides along cloth in a step; then the particle stays where it is on it
const int kOutTurns = 12;      // halvings of a way of which not all is known
const float kNever = 1e30;

/// When a particle that goes by `perStep` in a step may have come nearer to a triangle by `gap`, in steps.
float untilNearer(ClothSeen seen, vec3 perStep, float shares, float gap) {
  float parts = dot(seen.normal, perStep);
  float approach = shares * dot(seen.normal, seen.way) - parts;
  float most = shares * seen.fastest - parts;
  float faster = shares * seen.slope * length(perStep - shares * seen.way);
  float root = sqrt(approach * approach + 4.0 * faster * gap);
  float curved = approach > 0.0 ? 2.0 * gap / (approach + root)
                 : faster > 0.0 ? (root - approach) / (2.0 * faster)
                                : kNever;
  return most > 0.0 ? max(curved, gap / most) : kNever;
}

/// Where a particle on its way from y0, at the share `begin` of the step, to y1 at its end comes as near as `kept`,
/// still approaching.
struct ClothTouch {
  bool found;
  float at;  // share of the step
  float gap; // beyond what is kept [m]
  vec3 normal;
  vec3 place;  // of the particle [m]
  vec3 way;    // of the cloth there, in the step [m]
};
/// For how many steps from now a particle stays as near to its list's way as it must: all of `left`, or the last time
/// of some at which it does.
float untilOut(uint list, vec3 place, float field, vec3 perStep, float shares, float left, float kept) {
  float known = 0.0;  // and of `beyond` it is known that it is not
  float beyond = left;
  float at = left;
  int k = 0;
  do {
    bool isKnown = reachFrom(list, place + at * perStep, field + at * shares) >= kept;
    known = isKnown ? at : known;
    beyond = isKnown ? beyond : at;
    at = 0.5 * (known + beyond);
    ++clothTurns;
    ++k;
  } while (k <= kOutTurns && known < left);
  return known;
}

/// `held`: the way with which a particle goes on that is held after too many turns [m].
ClothTouch traceCloth(BodyStep body, vec3 y0, vec3 y1, float begin, float kept, vec3 held) {
  uint list = body.rest.lists[0];
  uint copy = copyOf(body.before.field);
  float shares = bendingShare(body);
  float left = 1.0 - begin;
  vec3 perStep = left > 0.0 ? (y1 - y0) / left : vec3(0);
  bool moves = longestWay(body.rest, copy) > 0.0;
  ClothTouch touch = ClothTouch(false, begin, 0.0, vec3(0), y0, vec3(0));
  int turn = 0;
  bool isDone = false;
  do {
    float field = body.before.field + touch.at * shares;
    float until = 1.0 - touch.at;
    bool found = false;
    bool isHeld = clothTurns >= kClothTurns;
    uint count = takenOf(list);
    for (uint k = 0; k < count; ++k) {
      uint triangle = clothLists[list].triangles[k];
      ClothSeen seen = clothSeen(body.rest, copy, field - float(copy), moves, triangle, touch.place);
      float gap = seen.distance - kept;
      bool approaches = (shares * dot(seen.normal, seen.way) - dot(seen.normal, perStep)) * left > kSlip;
      bool touches = approaches ? gap <= kTouchDistance : touch.at <= 0.0 && gap < -kTouchDistance;
      float first = untilNearer(seen, perStep, shares, approaches ? max(gap, 0.0) : max(gap, 0.0) + kTouchDistance);
      first = touches ? 0.0 : first;
      bool isFirst = (first < until || (touches && !found)) && !isDone;
      found = found || isFirst;
      until = isFirst ? first : until;
      touch.gap = isFirst ? gap : touch.gap;
      touch.normal = isFirst ? seen.normal : touch.normal;
      touch.way = isFirst ? shares * seen.way : touch.way;
    }
    float known = isHeld ? 0.0 : untilOut(list, touch.place, field, perStep, shares, until, kept);
    // Where triangles are not known, or after too many turns: held there.
    bool isOut = !isDone && (isHeld || known < until);
    vec3 onward = isHeld ? held : shares * clothLists[list].way;
    vec3 against = onward - perStep;
    touch.gap = isOut ? 0.0 : touch.gap;
    touch.normal = isOut ? (dot(against, against) > 0.0 ? normalize(against) : vec3(0, 1, 0)) : touch.normal;
    touch.way = isOut ? onward : touch.way;
    // Carried by the loop, see kDone.
    bool isLast = isOut || !found || until <= 0.0 || turn == kTraceTurns;
    touch.found = isDone ? touch.found : isOut || (found && isLast);
    touch.at += isDone ? 0.0 : isOut ? known : isLast ? 0.0 : until;
    touch.place = isDone ? touch.place : y0 + (touch.at - begin) * perStep;
    isDone = isDone || isLast;
    ++turn;
  } while (!isDone);
  return touch;
}

/// As keptOut, of cloth: on the side where the particle was, no nearer than is kept; one that began nearer, no nearer
/// than then.
KeptOut keptOff(BodyStep body, vec3 y0, vec3 y1) {
  float kept = min(body.rest.rounding, clothLists[body.rest.lists[0]].distance);
  vec3 place = y1;
  vec3 from = y0;
  vec3 normal = vec3(0);
  vec3 way = bent(body, bendingAtStart(body, y0));
  float begin = 0.0;
  int round = 0;
  bool isDone = false;
  do {
    ClothTouch touch = traceCloth(body, from, place, begin, kept, way);
    if (touch.found && !isDone) {
      vec3 held = touch.place + (1.0 - touch.at) * touch.way;
      normal = touch.normal;
      way = touch.way;
      from = touch.place;
      begin = touch.at;
      // Along the plane of what it touches.
      float beyond = dot(normal, place - held) + (touch.gap > kTouchDistance ? touch.gap : min(touch.gap, 0.0));
      place = round == kClothRounds ? held : place - min(beyond, 0.0) * normal;
    }
    isDone = isDone || !touch.found || round == kClothRounds;
    ++round;
  } while (!isDone);
  return KeptOut(place != y1, place, normal);
}
#endif

#endif
