// Where a particle or an edge meets a body within a step, and what velocities that leaves it (our choice; the paper has
// no bodies). In the body's frame, where it rests, ways are followed by the distance to its surface, which cannot be
// overshot ("sphere tracing", Hart 1996). Mirrored by reference/equations/body_contact.h, where there is a sketch.
#ifndef RINGLET_BODY_CONTACT
#define RINGLET_BODY_CONTACT

#include "shared/body_buffers.glsl"

const float kDone = 1e30;           // [m] along the way: tracing has ended. Results are carried by the loop, since
                                    // lavapipe keeps executing lanes that have left it and preserves only what the loop
                                    // carries
const float kTouchDistance = 1e-5;  // [m]: nearer counts as touching; a tenth of a hair
const float kOutside = 1e-4;        // [m]: no deeper counts as outside, and is put outside at once
const int kTraceTurns = 16;         // looks along a way; grazing ones give up and count as touching
const float kLeaveSpeed = 0.2;      // [m/s]: what begins inside leaves no faster
const float kDeep = 1e-3;           // [m]: what is deeper inside leaves across its strand, which else would be
                                    // stretched
const float kDeepShare = 0.04;      // or crushed, held by this share of the weight
const float kBodyWeight = 200.0;    // of what holds a particle at its allowed speed, in its masses
const float kFullDeficit = 0.01;    // [m/s]: of a deficit that gives half of that weight: without a ramp, rounding
                                    // would decide whether what just rests is held
const uint kMostBuried = 4;         // of a strand whose root is in a body, so many particles may be under its skin,
                                    // root included: these are not pushed
const uint kKeepOutRounds = 8;      // after the move, out of bodies and within the stretch limit, by turns, until edges
                                    // are short enough
const float kLeastShare = 0.2;      // an edge touched nearer its other end does not move this one

/// Where a way first touches.
struct Touch {
  bool found;
  bool passes;      // goes the whole way; neither, where an edge's end touches and the edge does not
  Surface surface;  // there
  vec3 place;       // in the body's frame [m]
  vec3 from;        // what was there at the step's start [m]
  float along;      // edges: share of the way from particle k to k + 1
  float before;     // particles: distance at the step's start [m]
};

Touch traceParticle(BodyRest body, vec3 y0, vec3 y1) {
  vec3 way = y1 - y0;
  float wayLength = length(way);
  Touch touch = Touch(true, false, Surface(0.0, vec3(0)), y0, y0, 0.0, 0.0);
  float gone = 0.0;
  int turn = 0;
  do {
    vec3 place = y0 + (gone / max(wayLength, 1e-20)) * way;
    Surface surface = bodyDistance(body, place);
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

/// Where the cubic with these values and slopes at 0 and 1 is least, for a first slope below 0 and a second above.
float leastOfCubic(float value0, float slope0, float value1, float slope1) {
  float rise = value1 - value0;
  float cube = slope0 + slope1 - 2.0 * rise;
  float square = 3.0 * rise - 2.0 * slope0 - slope1;
  float root = sqrt(max(0.0, square * square - 3.0 * cube * slope0));
  return clamp(-slope0 / max(square + root, 1e-20), 0.0, 1.0);
}

/// The place of an edge from a to b that is deepest. Where that is an end, it is its particle's; and an edge with an
/// end inside leaves with its particle.
struct EdgeSurface {
  bool isWithin;
  float along;
  Surface surface;
  vec3 place;
  float nearest;  // distance of the nearest of ends and place [m]
};
EdgeSurface edgeDistance(BodyRest body, vec3 a, vec3 b) {
  vec3 edge = b - a;
  Surface atA = bodyDistance(body, a);
  Surface atB = bodyDistance(body, b);
  float slopeA = dot(atA.normal, edge);
  float slopeB = dot(atB.normal, edge);
  bool isWithin = slopeA < 0.0 && slopeB > 0.0 && min(atA.distance, atB.distance) >= -kOutside;
  // Where its two slopes meet, which far from a thin body is it; then as a cubic, which near a round one is.
  float first = clamp((atB.distance - slopeB - atA.distance) / min(slopeA - slopeB, -1e-20), 0.0, 1.0);
  Surface there = bodyDistance(body, a + first * edge);
  float slope = dot(there.normal, edge);
  float rest = 1.0 - first;
  bool isBefore = slope > 0.0;
  float least = isBefore ? leastOfCubic(atA.distance, first * slopeA, there.distance, first * slope)
                         : leastOfCubic(there.distance, rest * slope, atB.distance, rest * slopeB);
  float along = isWithin ? (isBefore ? first * least : first + rest * least)
                         : (atA.distance < atB.distance ? 0.0 : 1.0);
  vec3 place = a + along * edge;
  Surface surface = bodyDistance(body, place);
  return EdgeSurface(isWithin, along, surface, place, min(min(atA.distance, atB.distance), surface.distance));
}

/// Both ends move straight, a0 to a1 and b0 to b1, until the edge touches between them, or one of them does.
Touch traceEdge(BodyRest body, vec3 a0, vec3 a1, vec3 b0, vec3 b1) {
  float longest = max(length(a1 - a0), length(b1 - b0));
  float gone = 0.0;
  EdgeSurface deepest = EdgeSurface(false, 0.0, Surface(0.0, vec3(0)), a0, 0.0);
  int turn = 0;
  bool passes = false;
  do {
    float share = gone / max(longest, 1e-20);
    EdgeSurface here = edgeDistance(body, a0 + share * (a1 - a0), b0 + share * (b1 - b0));
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

/// How fast what touches must at least part from the body along n [m/s]; negative: how fast it may near it.
float leastParting(Touch touch, float T) {
  return min((dot(touch.surface.normal, touch.place - touch.from) - touch.surface.distance) / T, kLeaveSpeed);
}

/// The weight that holds a particle of mass m which falls short of its least speed by `deficit` [m/s].
float bodyWeight(float mass, float deficit) { return mass * kBodyWeight * deficit / (deficit + kFullDeficit); }

/// The way out n of a particle so deep that its strand, along t, counts: across the strand, unless that is hardly out.
vec3 wayOutOfDepth(vec3 n, vec3 t) {
  vec3 across = n - dot(t, n) * t;
  float size = length(across);
  return size > 0.05 ? across / size : n;
}

/// Coulomb's friction, nearly all of it as a weight in the solve that takes `coefficient` times the normal momentum
/// from what slides as fast as was found without: a strand feels as a whole what holds one of its particles.
float frictionWeight(vec3 sliding, float normalMomentum, float coefficient, float mass) {
  float most = coefficient * max(normalMomentum, 0.0);
  return min(most / max(length(sliding), 1e-6), mass * kBodyWeight);
}

/// And what that left, from each particle by itself, so that what stops, stops.
vec3 rubbed(vec3 velocity, vec3 sliding, float weight, float normalMomentum, float coefficient, float mass) {
  float speed = length(sliding);
  float left = coefficient * max(normalMomentum, 0.0) - weight * speed;
  return speed > 0.0 && left > 0.0 ? velocity - min(1.0, left / mass / speed) * sliding : velocity;
}

/// What velocity into the body [m/s], relative to it and along n, hair loses that is put back by `shift` [m]: as much
/// as the shift is worth, and never so much that it bounces.
vec3 slowedInward(vec3 relative, vec3 n, float shift, float T) {
  return clamp(-dot(n, relative), 0.0, max(shift, 0.0) / T) * n;
}

/// A particle that began the step outside, at y0, and has moved to y1: out of the body, the way it came.
struct KeptOut {
  bool moved;
  vec3 place;
  vec3 normal;
};
KeptOut keptOut(BodyRest body, vec3 y0, vec3 y1) {
  Touch touch = traceParticle(body, y0, y1);
  // Onto the plane where it touched, then out of what curves beyond it; else back to the place itself.
  float beyond = dot(touch.surface.normal, y1 - touch.place) + touch.surface.distance;
  vec3 normal = touch.surface.normal;
  vec3 y = y1 - min(beyond, 0.0) * normal;
  float depth = -1.0;
  int turn = 0;
  do {
    Surface surface = bodyDistance(body, y);
    if (depth < 0.0) depth = surface.distance;
    if (depth < 0.0 && turn < 3) {
      y -= depth * surface.normal;
      normal = surface.normal;
    }
  } while (depth < 0.0 && ++turn <= 3);
  if (depth < -kOutside) y = touch.place;
  return KeptOut(touch.before >= -kOutside && touch.found && y != y1, y, normal);
}

#endif
