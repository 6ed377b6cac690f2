// Collisions of the particles of this lane's run with bodies, in the velocity solve and after the move.
// Included by kernels/strand_step.comp and integrators/jacobi.glsl. Mirrored by
// reference/kernels/body_step.h. A first loop tests all particles against a body and stores as bits those
// that may touch it; a second loop picks these from the run, one by one, and does the work. The first loop
// tests a few particles a turn: unrolled over the run, it would double the kernel's code.
#ifndef RINGLET_RUN_BODIES
#define RINGLET_RUN_BODIES

#include "bodies/near_bodies.glsl"
#include "equations/body_contact.glsl"
#include "equations/frame.glsl"
#include "maths/symmetric.glsl"
#include "shared/body_buffers.glsl"
#include "shared/strand_run.glsl"

// Sum of all bodies' pushes on particle k in the solve (weight * v = momentum). Friction uses only the
// heaviest push: xyz normal, w weight; xyz velocity of the body, w its friction; required speed along the
// normal.
Symmetric pushWeight[RUN];
vec3 pushMomentum[RUN];
vec4 pushNormal[RUN];
vec4 pushBody[RUN];
float pushTarget[RUN];
float rubbing[RUN];  // friction's weight along the surface
// The same for the next lane's first particle, pushed through the edge to it.
Symmetric nextWeight;
vec3 nextMomentum;
vec4 nextNormal;
vec4 nextBody;
float nextTarget;

vec3 pStart[RUN];  // positions before the move
bool isClear;      // nothing of the strand touches a body during the step, at the velocities without bodies

// The first loop tests kPart particles at a time, a part of the run; it includes the next lane's first
// particle. The bits of ten parts fill a word; a run in memory may have more parts and is processed word by
// word.
const int kPart = 3;
const uint kLookParts = (RUN + kPart) / kPart;
const uint kPartsOfWord = 10;
bool fillsWord(uint part) { return kInMemory && part % kPartsOfWord == 0; }
// Whether another word of parts follows; else the run is done.
bool isAnotherWord(uint part) { return kInMemory && part < kLookParts; }

// Picks a value from the run. In registers this compares indices, since an array that is indexed by a
// variable lives in memory.
//   RINGLET_PICK(values, next, k)           of particle k of the run; RUN is the next lane's first
//   RINGLET_LOOK_AT(values, next, part, j)  the same for the first loop: of particle j of a part of the run
//   RINGLET_AT(j, k, something)             does something with particle j = k, if the run has it
#ifdef RINGLET_IN_MEMORY
#define RINGLET_PICK(values, next, k) ((k) < RUN ? values[min(k, RUN - 1)] : next)
#define RINGLET_LOOK_AT(values, next, part, j) RINGLET_PICK(values, next, int(part) * kPart + j)
#define RINGLET_AT(j, k, something) \
  if ((k) < RUN) {                  \
    int j = min(k, RUN - 1);        \
    something;                      \
  }
#else
vec3 picked(vec3 values[RUN], vec3 next, int k) {
  vec3 value = next;
  [[unroll]] for (int j = 0; j < RUN; ++j) value = j == k ? values[j] : value;
  return value;
}
vec3 pickedInPart(vec3 values[RUN], vec3 next, uint part, int j) {
  vec3 value = next;
  [[unroll]] for (int q = 0; q < kLookParts; ++q) {
    int k = q * kPart + j;
    if (k < RUN) value = q == part ? values[min(k, RUN - 1)] : value;
  }
  return value;
}
#define RINGLET_PICK(values, next, k) picked(values, next, k)
#define RINGLET_LOOK_AT(values, next, part, j) pickedInPart(values, next, part, j)
#define RINGLET_AT(j, k, something) \
  [[unroll]] for (int j = 0; j < RUN; ++j) { if (j == (k)) something; }
#endif

// The strand's tangent at particle k; edgeBefore: direction of the edge that ends at this lane's first
// particle.
vec3 tangentAt(int k, vec3 edgeBefore) {
  vec3 sum = vec3(0);
  RINGLET_AT(j, k, sum = (j > 0 ? eHat[max(j - 1, 0)] : edgeBefore) + (isEdge(j) ? eHat[j] : vec3(0)))
  return directionOf(sum);
}

void clearPushes() {
  RINGLET_OVER_RUN for (int k = 0; k < runEnd; ++k) {
    pushWeight[k] = symmetricDiagonal(0.0);
    pushMomentum[k] = vec3(0);
    pushNormal[k] = vec4(0);
    pushBody[k] = vec4(0);
    pushTarget[k] = 0.0;
    rubbing[k] = 0.0;
  }
  nextWeight = symmetricDiagonal(0.0);
  nextMomentum = vec3(0);
  nextNormal = vec4(0);
  nextBody = vec4(0);
  nextTarget = 0.0;
}

void pushParticle(int j, float weight, vec3 n, float target, vec3 u, float friction) {
  pushWeight[j] = addOuter(pushWeight[j], weight, n);
  pushMomentum[j] += (weight * target) * n;
  if (weight > pushNormal[j].w) {
    pushNormal[j] = vec4(n, weight);
    pushBody[j] = vec4(u, friction);
    pushTarget[j] = target;
  }
}
void push(int k, float weight, vec3 n, float target, vec3 u, float friction) {
#ifdef RINGLET_IN_MEMORY
  if (k < RUN) pushParticle(min(k, RUN - 1), weight, n, target, u, friction);
#else
  [[unroll]] for (int j = 0; j < RUN; ++j) pushParticle(j, j == k ? weight : 0.0, n, target, u, friction);
#endif
  float beyond = k == RUN ? weight : 0.0;
  nextWeight = addOuter(nextWeight, beyond, n);
  nextMomentum += (beyond * target) * n;
  if (beyond > nextNormal.w) {
    nextNormal = vec4(n, beyond);
    nextBody = vec4(u, friction);
    nextTarget = target;
  }
}

// Adds the pushes that the lane before has found for this one's first particle.
void passPushesOn() {
  Symmetric weight = Symmetric(fromRootward(nextWeight.d, 1), fromRootward(nextWeight.o, 1));
  vec3 momentum = fromRootward(nextMomentum, 1);
  vec4 normal = fromRootward(nextNormal, 1);
  vec4 body = fromRootward(nextBody, 1);
  float target = fromRootward(nextTarget, 1);
  if (lane == 0) return;
  pushWeight[0] = add(pushWeight[0], weight);
  pushMomentum[0] += momentum;
  if (normal.w > pushNormal[0].w) {
    pushNormal[0] = normal;
    pushBody[0] = body;
    pushTarget[0] = target;
  }
}

float massAt(int k, float next) {
  float mass = next;
  RINGLET_AT(j, k, mass = restEdge[j].x)
  return mass;
}
bool isPinnedAt(int k) { return first + k < rootCount(); }

bool isOfCloth(BodyRest body) {
#ifdef RINGLET_BENDING
  return isCloth(body);
#else
  return false;
#endif
}

/// The body, as the particles k and l know it.
BodyStep knownAt(BodyStep body, int k, int l) {
#ifdef RINGLET_BENDING
  uint at = strand.firstParticle + first;
  if (kCloth)
    body.rest.lists = uint[2](clothListOf(body.rest, at + k, parameters.particleCount),
                              clothListOf(body.rest, at + l, parameters.particleCount));
#endif
  return body;
}

struct NextParticle {  // first particle of the next lane
  vec3 p;
  vec3 v;
  float mass;
};

// Adds a body's pushes on the edge from particle k to l, at the end that touches first or between the ends;
// or, if k = l, on particle k, but for the next lane's first, which that lane asks. Returns whether it touches.
bool askOf(BodyStep anywhere, int k, int l, NextParticle next, vec3 edgeBefore, inout uint touched,
           inout uint asked) {
  BodyStep body = knownAt(anywhere, k, l);
  float T = stepSeconds();
  bool isOne = k == l;
  vec3 a = RINGLET_PICK(p, next.p, k);
  vec3 c = RINGLET_PICK(p, next.p, l);
  vec3 va = RINGLET_PICK(v, next.v, k);
  vec3 vc = RINGLET_PICK(v, next.v, l);
  vec3 a0 = placeAtStart(body, a);
  vec3 c0 = placeAtStart(body, c);
  vec3 a1 = placeAtEnd(body, a + T * va);
  vec3 c1 = placeAtEnd(body, c + T * vc);
  Touch touch;
#ifdef RINGLET_BENDING
  bool isOnCloth = isOne && isCloth(body.rest);
  ClothTouch cloth;
  if (isOnCloth) {
    cloth = traceCloth(body, a0, a1, 0.0, body.rest.rounding, bent(body, bendingAtStart(body, a0)));
    touch = Touch(cloth.found, !cloth.found, Surface(cloth.gap, cloth.normal), cloth.place,
                  a0 + cloth.at * cloth.way, 0.0, 0.0);
  } else
#endif
    touch = traceEdge(body.rest, body.before.field, a0, a1 - bentOnPath(body, a0, a1), c0,
                      c1 - bentOnPath(body, c0, c1));
  touched |= touch.passes ? 0 : 1;
  bool isDeep = isOne && touch.surface.distance < -kDeep;
  vec3 n = outward(body, touch.surface.normal);
  if (isDeep) n = wayOutOfDepth(n, tangentAt(k, edgeBefore));
  vec2 shares = isOne ? vec2(1, 0) : vec2(1.0 - touch.along, touch.along);
  vec3 from = shares.x * a + shares.y * c;
  vec3 u = surfaceVelocityAt(body, from, bendingAtStart(body, placeAtStart(body, from)), T);
#ifdef RINGLET_BENDING
  if (isOnCloth) u = bodyVelocityAt(body, from, T) + rotate(body.after.rotation, cloth.way) / T;
#endif
  float least = dot(n, u) + leastParting(touch, T);
  float deficit = least - dot(n, shares.x * va + shares.y * vc);
  bool touches = isOne ? !touch.passes : touch.found;
  if (!touches || !(deficit > 0.0)) return touches;
  vec2 parting = shares * (deficit / dot(shares, shares));
  int end = 0;
  do {
    int m = end == 0 ? k : l;
    float share = end == 0 ? shares.x : shares.y;
    float weight = share * (isDeep ? kDeepShare : 1.0) * bodyWeight(massAt(m, next.mass), deficit);
    float target = isOne ? least : dot(n, end == 0 ? va : vc) + (end == 0 ? parting.x : parting.y);
    bool isOthers = isOne && m == RUN;
    push(m, isPinnedAt(m) || isOthers || share < kLeastShare ? 0.0 : weight, n, target, u, body.rest.friction);
  } while (++end < (isOne ? 1 : 2));
  asked = 1;
  return true;
}

// Finds the pushes of all bodies, from positions and v, the velocities without bodies. Returns whether there
// are pushes on the strand; sets isClear.
bool findPushes(uint step) {
  float T = stepSeconds();
  NextParticle next =
      NextParticle(fromTipward(p[0], 1), fromTipward(v[0], 1), fromTipward(vec3(restEdge[0].x), 1).x);
  vec3 edgeBefore = fromRootward(eHat[RUN - 1], 1);
  Room room = emptyRoom();
  float fastest = 0.0;
  RINGLET_OVER_RUN for (int k = 0; k <= runEnd; ++k) {
    if (k < RUN ? !isParticle(k) : !isEdge(RUN - 1)) continue;
    include(room, k < RUN ? p[min(k, RUN - 1)] : next.p);
    vec3 velocity = k < RUN ? v[min(k, RUN - 1)] : next.v;
    fastest = max(fastest, dot(velocity, velocity));
  }
  float reach = T * sqrt(fastest) + kTouchDistance;
  uint asked = 0;
  uint touched = 0;
  uint b = nextNear(room, reach, step, numbers.bodyCount, 0);
  if (b < numbers.bodyCount) do {
    BodyStep body = bodyStep(step, numbers.bodyCount, b);
    float roomBefore = 0.0;  // distance left to the body after particle k - 1 has moved
    bool isBuried = lane == 0 && !kFalls;  // fallen hair has no root that may be in a body
    vec3 placeBefore = vec3(0);
    uint touchesBefore = 0;  // whether the last particle of the word before touches
    uint part = 0;
    do {
      int before = int(part) * kPart - 1;  // the edge of bit 0 ends at the particle of bit 0
      uint particleBits = 0;
      uint edgeBits = 0;
      uint touching = 0;  // the particles that touch
      [[dont_unroll]] do {
        [[unroll]] for (int j = 0; j < kPart; ++j) {
          int k = int(part) * kPart + j;
          vec3 position = RINGLET_LOOK_AT(p, next.p, part, j);
          vec3 velocity = RINGLET_LOOK_AT(v, next.v, part, j);
          vec3 place = placeAtStart(body, position);
          BodyStep here = knownAt(body, k, k);
          Bending bending = bendingAtStart(here, place);
          float way = T * length(velocity - surfaceVelocityAt(body, position, bending, T));
          float distance = surfaceAt(here.rest, body.before.field, place, bending).distance;
          float left = distance - 1.001 * way - 2.0 * kTouchDistance - bendingRoom(body, bending);
          isBuried = isBuried && k < kMostBuried && distance < -kOutside;
          bool mayTouch = k < RUN ? isFree(k) : k == RUN && isEdge(RUN - 1) && !isPinnedAt(RUN);
          if (mayTouch && left <= 0.0 && !isBuried) particleBits |= 1u << (k - before - 1);
          if (k > 0 && k <= RUN && isEdge(k - 1) && left + roomBefore <= length(position - placeBefore))
            edgeBits |= 1u << (k - before - 1);
          roomBefore = left;
          placeBefore = position;
        }
      } while (++part < kLookParts && !fillsWord(part));
      if ((particleBits | edgeBits) != 0) do {
        bool isOne = particleBits != 0;
        int bit = findLSB(isOne ? particleBits : edgeBits);
        int k = before + bit + (isOne ? 1 : 0);
        if (askOf(body, k, isOne ? k : k + 1, next, edgeBefore, touched, asked) && isOne) touching |= 1u << bit;
        edgeBits &= isOne ? ~0u : edgeBits - 1;
        particleBits &= particleBits - 1;
        // An edge whose ends both touch asks nothing: it would ask them again, and throw them off.
        if (particleBits == 0) edgeBits &= ~(touching & (touching << 1 | touchesBefore));
      } while ((particleBits | edgeBits) != 0);
      touchesBefore = touching >> (kPart * kPartsOfWord - 1);
    } while (isAnotherWord(part));
    b = nextNear(room, reach, step, numbers.bodyCount, b + 1);
  } while (b < numbers.bodyCount);
  passPushesOn();
  isClear = sumOverStrand(touched) == 0;
  return sumOverStrand(asked) > 0;
}

float normalMomentum(int k) { return pushNormal[k].w * (pushTarget[k] - dot(pushNormal[k].xyz, v[k])); }
vec3 slidingVelocity(int k) {
  vec3 relative = v[k] - pushBody[k].xyz;
  return relative - dot(pushNormal[k].xyz, relative) * pushNormal[k].xyz;
}

// Adds the weights of friction, from the normal momentum of the pushes at the velocities solved without
// friction.
void addFriction() {
  RINGLET_OVER_RUN for (int k = 0; k < runEnd; ++k) {
    vec3 n = pushNormal[k].xyz;
    rubbing[k] = isFree(k) ? frictionWeight(slidingVelocity(k), normalMomentum(k), pushBody[k].w, restEdge[k].x) : 0.0;
    pushWeight[k] = addOuter(addDiagonal(pushWeight[k], rubbing[k]), -rubbing[k], n);
    pushMomentum[k] += rubbing[k] * (pushBody[k].xyz - dot(n, pushBody[k].xyz) * n);
  }
}

// Applies what is left of friction at the velocities solved with it.
void rubRun() {
  RINGLET_OVER_RUN for (int k = 0; k < runEnd; ++k) {
    vec3 slowed = rubbed(v[k], slidingVelocity(k), rubbing[k], normalMomentum(k), pushBody[k].w, restEdge[k].x);
    if (isFree(k)) v[k] = slowed;
  }
}

void moveParticle(int j, vec3 place, vec3 change) {
  p[j] = place;
  v[j] += change;
}

void keepParticlesOut(uint step, Room room, bool isDone) {
  float T = stepSeconds();
  uint b = isDone ? numbers.bodyCount : nextNear(room, kTouchDistance, step, numbers.bodyCount, 0);
  if (b < numbers.bodyCount) do {
    BodyStep body = bodyStep(step, numbers.bodyCount, b);
    uint part = 0;
    do {
      int begin = int(part) * kPart;
      uint bits = 0;
      [[dont_unroll]] do {
        [[unroll]] for (int j = 0; j < kPart; ++j) {
          int k = int(part) * kPart + j;
          vec3 y1 = placeAtEnd(body, RINGLET_LOOK_AT(p, vec3(0), part, j));
          vec3 y0 = placeAtStart(body, RINGLET_LOOK_AT(pStart, vec3(0), part, j));
          BodyStep here = knownAt(body, k, k);
          Bending bending = bendingAtStart(here, y0);
          float way = length(y1 - bent(body, bending) - y0);
          float distance = bending.cloth.distance - way;  // of cloth, at least
          if (!isOfCloth(body.rest)) distance = surfaceAt(here.rest, body.after.field, y1).distance;
          bool isNear = distance <= 1.001 * way + 2.0 * kTouchDistance + bendingRoom(body, bending);
          if (k < RUN && isFree(k) && isNear) bits |= 1u << (k - begin);
        }
      } while (++part < kLookParts && !fillsWord(part));
      if (bits != 0) do {
        int k = begin + findLSB(bits);
        bits &= bits - 1;
        BodyStep here = knownAt(body, k, k);
        vec3 start = RINGLET_PICK(pStart, vec3(0), k);
        vec3 y0 = placeAtStart(body, start);
        KeptOut kept = keptOut(here, y0, placeAtEnd(body, RINGLET_PICK(p, vec3(0), k)));
        vec3 place = outOfBody(body, kept.place);
        vec3 n = outward(body, kept.normal);
        vec3 u = surfaceVelocityAt(body, start, bendingAtStart(here, y0), T);
        vec3 slowed = slowedInward(RINGLET_PICK(v, vec3(0), k) - u, n,
                                   dot(n, place - RINGLET_PICK(p, vec3(0), k)), T);
        if (kept.moved) {
          RINGLET_AT(j, k, moveParticle(j, place, slowed))
        }
      } while (bits != 0);
    } while (isAnotherWord(part));
    b = nextNear(room, kTouchDistance, step, numbers.bodyCount, b + 1);
  } while (b < numbers.bodyCount);
}

// Keeps the larger of two displacements, with its change of velocity.
void furtherOf(inout vec3 shift, inout vec3 change, vec3 wanted, vec3 wantedChange) {
  if (dot(wanted, wanted) <= dot(shift, shift)) return;
  shift = wanted;
  change = wantedChange;
}

// Pushes edges out of bodies, at kLeaveSpeed at most. If two edges move a particle, the larger displacement
// counts.
void keepEdgesOut(uint step, Room room, bool isDone) {
  float T = stepSeconds();
  vec3 pNext = fromTipward(p[0], 1);
  vec3 vNext = fromTipward(v[0], 1);
  vec3 startNext = fromTipward(pStart[0], 1);
  vec3 shift[RUN];
  vec3 change[RUN];
  RINGLET_OVER_RUN for (int k = 0; k < runEnd; ++k) shift[k] = change[k] = vec3(0);
  vec3 nextShift = vec3(0);
  vec3 nextChange = vec3(0);
  if (isEdge(RUN - 1)) include(room, pNext);
  uint b = isDone ? numbers.bodyCount : nextNear(room, kTouchDistance, step, numbers.bodyCount, 0);
  if (b < numbers.bodyCount) do {
    BodyStep body = bodyStep(step, numbers.bodyCount, b);
    float distanceBefore = 0.0;
    vec3 placeBefore = vec3(0);
    uint part = 0;
    do {
      int before = int(part) * kPart - 1;
      uint bits = 0;
      [[dont_unroll]] do {
        [[unroll]] for (int j = 0; j < kPart; ++j) {
          int k = int(part) * kPart + j;
          vec3 place = RINGLET_LOOK_AT(p, pNext, part, j);
          BodyRest here = knownAt(body, k, k).rest;
          float distance = surfaceAt(here, body.after.field, placeAtEnd(body, place)).distance;
          bool isNear = distance + distanceBefore <= 1.001 * length(place - placeBefore);
          if (k > 0 && k <= RUN && isEdge(k - 1) && isNear) bits |= 1u << (k - before - 1);
          distanceBefore = distance;
          placeBefore = place;
        }
      } while (++part < kLookParts && !fillsWord(part));
      if (bits != 0) do {
        int k = before + findLSB(bits);
        bits &= bits - 1;
        BodyStep edge = knownAt(body, k, k + 1);
        EdgeSurface deepest = edgeDistance(edge.rest, body.after.field, placeAtEnd(body, RINGLET_PICK(p, pNext, k)),
                                           placeAtEnd(body, RINGLET_PICK(p, pNext, k + 1)));
        if (!deepest.isWithin || deepest.surface.distance >= 0.0) continue;
        vec3 n = outward(body, deepest.surface.normal);
        vec2 shares = vec2(1.0 - deepest.along, deepest.along);
        vec2 part = shares / dot(shares, shares);
        float outBy = min(-deepest.surface.distance, kLeaveSpeed * T);
        vec3 start =
            shares.x * RINGLET_PICK(pStart, startNext, k) + shares.y * RINGLET_PICK(pStart, startNext, k + 1);
        vec3 velocity = shares.x * RINGLET_PICK(v, vNext, k) + shares.y * RINGLET_PICK(v, vNext, k + 1);
        Bending bending = bendingAtStart(edge, placeAtStart(body, start));
        vec3 slowed = slowedInward(velocity - surfaceVelocityAt(body, start, bending, T), n, outBy, T);
        int end = 0;
        do {
          float share = isPinnedAt(k + end) ? 0.0 : end == 0 ? part.x : part.y;
          vec3 wanted = (share * outBy) * n;
          RINGLET_AT(j, k + end, furtherOf(shift[j], change[j], wanted, share * slowed))
          if (k + end == RUN) furtherOf(nextShift, nextChange, wanted, share * slowed);
        } while (++end < 2);
      } while (bits != 0);
    } while (isAnotherWord(part));
    b = nextNear(room, kTouchDistance, step, numbers.bodyCount, b + 1);
  } while (b < numbers.bodyCount);
  vec3 rootwardShift = fromRootward(nextShift, 1);
  vec3 rootwardChange = fromRootward(nextChange, 1);
  if (lane > 0 && dot(rootwardShift, rootwardShift) > dot(shift[0], shift[0])) {
    shift[0] = rootwardShift;
    change[0] = rootwardChange;
  }
  RINGLET_OVER_RUN for (int k = 0; k < runEnd; ++k) {
    p[k] = isDone ? p[k] : p[k] + shift[k];
    v[k] = isDone ? v[k] : v[k] + change[k];
  }
}

// isDone: the strand needs nothing.
void keepRunOut(uint step, bool isDone) {
  Room room = emptyRoom();
  RINGLET_OVER_RUN for (int k = 0; k < runEnd; ++k) {
    if (!isParticle(k)) continue;
    include(room, pStart[k]);
    include(room, p[k]);
  }
  keepParticlesOut(step, room, isDone);
  keepEdgesOut(step, room, isDone);
}

#endif
