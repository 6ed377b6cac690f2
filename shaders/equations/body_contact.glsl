// Where a particle or an edge touches a body within a step, and the velocities it may then have (our choice;
// the paper has no bodies). In the body's frame, where the body is at rest, motion is traced by the distance
// to the surface, which cannot be overshot ("sphere tracing", Hart 1996). Of a body that bends, that is the
// distance in the field of the step's start, and a path is what is left of it once the surface's own way is taken
// off. Mirrored by
// reference/equations/body_contact.h, which has a sketch.
#ifndef RINGLET_BODY_CONTACT
#define RINGLET_BODY_CONTACT

#include "equations/cloth_contact.glsl"
#include "shared/bending_buffers.glsl"
#include "shared/kept_out.glsl"

const float kDone = 1e30;           // [m] along the path: tracing has ended. Results are carried by the loop,
                                    // since lavapipe keeps executing lanes that have left it and preserves
                                    // only what the loop carries
const float kOutside = 1e-4;        // [m]: a smaller depth counts as outside, and is corrected at once
const float kLeaveSpeed = 0.2;      // [m/s]: largest speed at which something that began inside leaves
const float kDeep = 1e-3;           // [m]: a deeper particle leaves across its strand, which would otherwise
                                    // be stretched
const float kHeldDepth = 2e-3;      // [m]: what began no deeper goes no deeper; beyond, the way out may be on
                                    // any side: it may go deeper by this
const float kGivenDepth = 20.0;     // multiple of how far beyond it began, without a jump by which rounding
                                    // would show
const float kDeepShare = 0.04;      // or crushed; it is held by this share of the weight
const float kBodyWeight = 200.0;    // weight that holds a particle at its allowed speed, in its masses
const float kFullDeficit = 0.01;    // [m/s]: the deficit with half of that weight: without a ramp, rounding
                                    // would decide whether a resting particle is held
const uint kMostBuried = 4;         // if a strand's root is in a body, this many particles, root included,
                                    // may be under its skin and are not pushed
const uint kKeepOutRounds = 8;      // after the move, rounds of pushing out of bodies and limiting stretch,
                                    // until edges are short enough
const float kLeastShare = 0.2;      // an edge touched closer to its other end than this does not move this
                                    // end

/// Where a path first touches a body.
struct Touch {
  bool found;
  bool passes;      // nothing touches; both are false if an end of an edge touches but the edge does not
  Surface surface;  // at the place of contact
  vec3 place;       // of contact, in the body's frame [m]
  vec3 from;        // where that point was at the step's start [m]
  float along;      // edges: position on the edge, 0 at particle k, 1 at k + 1
  float before;     // particles: distance at the step's start [m]
};

Touch traceParticle(BodyRest body, float field, vec3 y0, vec3 y1) {
  vec3 way = y1 - y0;
  float wayLength = length(way);
  Touch touch = Touch(true, false, Surface(0.0, vec3(0)), y0, y0, 0.0, 0.0);
  float gone = 0.0;
  int turn = 0;
  do {
    vec3 place = y0 + (gone / max(wayLength, 1e-20)) * way;
    Surface surface = surfaceAt(body, field, place);
    if (gone < kDone) {
      touch.place = place;
      touch.surface = surface;
      if (turn == 0) touch.before = surface.distance;
      touch.found = surface.distance <= kTouchDistance || turn == kTraceTurns || gone + surface.distance < wayLength;
    }
    gone = surface.distance > kTouchDistance && touch.found && turn < kTraceTurns ? gone + surface.distance : kDone;
    ++turn;
  } while (gone < kDone);
  touch.passes = !touch.found;
  return touch;
}

/// The minimum of the cubic with these values and slopes at 0 and 1; the first slope is negative, the second
/// positive.
float leastOfCubic(float value0, float slope0, float value1, float slope1) {
  float rise = value1 - value0;
  float cube = slope0 + slope1 - 2.0 * rise;
  float square = 3.0 * rise - 2.0 * slope0 - slope1;
  float root = sqrt(max(0.0, square * square - 3.0 * cube * slope0));
  return clamp(-slope0 / max(square + root, 1e-20), 0.0, 1.0);
}

/// The deepest place of an edge from a to b. isWithin is false if that is an end, which counts as its
/// particle's contact; an edge with an end inside leaves with that particle.
struct EdgeSurface {
  bool isWithin;
  float along;
  Surface surface;
  vec3 place;
  float nearest;  // smallest distance of the ends and the place [m]
};
/// At a place of an edge; side: the sum of the normals at its ends. Only cloth has two sides: where the edge dips into
/// it, the way back to that of its ends.
Surface surfaceBetween(BodyRest body, float field, vec3 y, vec3 side) {
  Surface surface = surfaceAt(body, field, y);
#ifdef RINGLET_BENDING
  bool dips = dot(side, side) > kOneSide && dot(surface.normal, side) < 0.0;
  if (isCloth(body) && dips)
    surface = Surface(-surface.distance - 2.0 * body.rounding, -surface.normal);
#endif
  return surface;
}
/// Whether the edge goes from one side to the other there, so that there is no way out.
bool goesThrough(BodyRest body, Surface surface, vec3 side) {
#ifdef RINGLET_BENDING
  return isCloth(body) && dot(side, side) <= kOneSide && surface.distance + body.rounding < kThrough;
#else
  return false;
#endif
}
EdgeSurface edgeDistance(BodyRest body, float field, vec3 a, vec3 b) {
  vec3 edge = b - a;
  Surface atA = surfaceAt(body, field, a);
  Surface atB = surfaceAt(body, field, b);
  float slopeA = dot(atA.normal, edge);
  float slopeB = dot(atB.normal, edge);
  bool isWithin = slopeA < 0.0 && slopeB > 0.0 && min(atA.distance, atB.distance) >= -kOutside;
  // First where its end slopes meet, which is the place far from a thin body; then as a cubic, which fits
  // near a round one.
  float first = clamp((atB.distance - slopeB - atA.distance) / min(slopeA - slopeB, -1e-20), 0.0, 1.0);
  vec3 side = atA.normal + atB.normal;
  Surface there = surfaceBetween(body, field, a + first * edge, side);
  float slope = dot(there.normal, edge);
  float rest = 1.0 - first;
  bool isBefore = slope > 0.0;
  float least = isBefore ? leastOfCubic(atA.distance, first * slopeA, there.distance, first * slope)
                         : leastOfCubic(there.distance, rest * slope, atB.distance, rest * slopeB);
  float along = isWithin ? (isBefore ? first * least : first + rest * least)
                         : (atA.distance < atB.distance ? 0.0 : 1.0);
  vec3 place = a + along * edge;
  Surface surface = surfaceBetween(body, field, place, isWithin ? side : vec3(0));
  isWithin = isWithin && !goesThrough(body, surface, side);
  return EdgeSurface(isWithin, along, surface, place, min(min(atA.distance, atB.distance), surface.distance));
}

/// Both ends move straight, a0 to a1 and b0 to b1, until the edge touches between them, or an end touches.
Touch traceEdge(BodyRest body, float field, vec3 a0, vec3 a1, vec3 b0, vec3 b1) {
  float longest = max(length(a1 - a0), length(b1 - b0));
  float gone = 0.0;
  EdgeSurface deepest = EdgeSurface(false, 0.0, Surface(0.0, vec3(0)), a0, 0.0);
  int turn = 0;
  bool passes = false;
  do {
    float share = gone / max(longest, 1e-20);
    EdgeSurface here = edgeDistance(body, field, a0 + share * (a1 - a0), b0 + share * (b1 - b0));
    bool touches = here.nearest <= kTouchDistance || turn == kTraceTurns;
    if (gone < kDone) {
      deepest = here;
      passes = !touches && gone + here.nearest >= longest;
    }
    gone = touches || passes ? kDone : gone + here.nearest;
    ++turn;
  } while (gone < kDone);
  return Touch(!passes && deepest.isWithin && deepest.surface.distance <= kTouchDistance, passes, deepest.surface,
               deepest.place, a0 + deepest.along * (b0 - a0), deepest.along, 0.0);
}

/// The least speed along n at which a touching place must part from the body [m/s]; negative: it may approach
/// this fast.
float leastParting(Touch touch, float T) {
  return min((dot(touch.surface.normal, touch.place - touch.from) - touch.surface.distance) / T, kLeaveSpeed);
}

/// The weight that holds a particle of mass m whose speed is `deficit` too small [m/s].
float bodyWeight(float mass, float deficit) { return mass * kBodyWeight * deficit / (deficit + kFullDeficit); }

/// The direction in which a deep particle leaves, for normal n and tangent t of its strand: across the
/// strand, unless that hardly leads outwards.
vec3 wayOutOfDepth(vec3 n, vec3 t) {
  vec3 across = n - dot(t, n) * t;
  float size = length(across);
  return size > 0.05 ? across / size : n;
}

/// Coulomb friction, most of it: a weight for the solve that takes `coefficient` times the normal momentum
/// from a particle that slides as fast as was found without friction. A strand as a whole then feels what
/// holds one of its particles.
float frictionWeight(vec3 sliding, float normalMomentum, float coefficient, float mass) {
  float most = coefficient * max(normalMomentum, 0.0);
  return min(most / max(length(sliding), 1e-6), mass * kBodyWeight);
}

/// The rest of the friction, applied to each particle alone, so that sliding stops completely.
vec3 rubbed(vec3 velocity, vec3 sliding, float weight, float normalMomentum, float coefficient, float mass) {
  float speed = length(sliding);
  float left = coefficient * max(normalMomentum, 0.0) - weight * speed;
  return speed > 0.0 && left > 0.0 ? velocity - min(1.0, left / mass / speed) * sliding : velocity;
}

/// The velocity into the body [m/s], relative to it and along n, that hair loses if it is moved out by
/// `shift` [m]: at most what corresponds to the shift, and never so much that it bounces.
vec3 slowedInward(vec3 relative, vec3 n, float shift, float T) {
  return clamp(-dot(n, relative), 0.0, max(shift, 0.0) / T) * n;
}

/// A particle that began the step at y0 and has moved to y1: moves it out of the body where it came in, or if it
/// began inside, to the depth that this allows (kHeldDepth). The place of contact moves on with the surface; where
/// another surface has closed in on it, it leaves that one.
KeptOut keptOut(BodyStep body, vec3 y0, vec3 y1) {
#ifdef RINGLET_BENDING
  if (isCloth(body.rest)) return keptOff(body, y0, y1);
#endif
  Touch touch = traceParticle(body.rest, body.before.field, y0, y1 - bentOnPath(body, y0, y1));
  vec3 held = touch.place + bent(body, touch.place);
  float kept = min(touch.before + kOutside, 0.0) + kGivenDepth * min(touch.before + kHeldDepth, 0.0);
  // Onto the plane where it touched, then out of what curves beyond it; if that fails, back to the place of
  // contact.
  float beyond = dot(touch.surface.normal, y1 - held) + touch.surface.distance - kept;
  vec3 normal = touch.surface.normal;
  vec3 y = y1 - min(beyond, 0.0) * normal;
  bool isWithin = false;  // though nothing was met: the surface by which it ends moves otherwise
#ifdef RINGLET_BENDING
  if (!touch.found) y = y1;
#endif
  float depth = -1.0;
  int turn = 0;
  do {
    Surface surface = surfaceAt(body.rest, body.after.field, y);
    if (depth < 0.0) depth = surface.distance - kept;
#ifdef RINGLET_BENDING
    isWithin = isWithin || (turn == 0 && surface.distance < kept);
#endif
    if (depth < 0.0 && turn < 3) {
      y -= depth * surface.normal;
      normal = surface.normal;
    }
  } while (depth < 0.0 && ++turn <= 3);
  if (depth < -kOutside) {
    y = held;
#ifdef RINGLET_BENDING
    Surface closing = surfaceAt(body.rest, body.after.field, held);
    y -= min(closing.distance - kept, 0.0) * closing.normal;
#endif
  }
  return KeptOut((touch.found || isWithin) && y != y1, y, normal);
}

#endif
