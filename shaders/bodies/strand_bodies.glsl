// Bodies in the form of one thread per strand: what they ask of its particles, in the velocity solve and after the
// move. Included by kernels/strand_step_serial.comp; the lanes form has run_bodies.glsl. Mirrored by
// reference/kernels/body_step.h.
#include "bodies/near_bodies.glsl"
#include "equations/body_contact.glsl"

void clearPushes() {
  for (uint i = 0; i < count; ++i) {
    for (uint field = kPushWeight; field < kPushWeight + kBodyScratch; ++field) scratch[slot(i, field)] = vec4(0);
  }
}

void push(uint i, float weight, vec3 n, float target, vec3 u, float friction) {
  Symmetric sum = addOuter(Symmetric(scratchOf(i, kPushWeight), scratchOf(i, kPushWeight + 1)), weight, n);
  vec3 momentum = vec3(scratch[slot(i, kPushWeight)].w, scratch[slot(i, kPushWeight + 1)].w,
                       scratch[slot(i, kPushRest)].x) +
                  (weight * target) * n;
  bool isHeaviest = weight > scratch[slot(i, kPushNormal)].w;
  scratch[slot(i, kPushWeight)] = vec4(sum.d, momentum.x);
  scratch[slot(i, kPushWeight + 1)] = vec4(sum.o, momentum.y);
  scratch[slot(i, kPushRest)] = vec4(momentum.z, isHeaviest ? target : scratch[slot(i, kPushRest)].y, 0, 0);
  if (!isHeaviest) return;
  scratch[slot(i, kPushNormal)] = vec4(n, weight);
  scratch[slot(i, kPushBody)] = vec4(u, friction);
}

bool findPushes(uint step) {
  float T = stepSeconds();
  Room room = emptyRoom();
  float fastest = 0.0;
  for (uint i = 0; i < count; ++i) {
    include(room, position(i));
    fastest = max(fastest, dot(solvedVelocity(i), solvedVelocity(i)));
  }
  float reach = T * sqrt(fastest) + kTouchDistance;
  bool asked = false;
  for (uint b = nextNear(room, reach, step, parameters.bodyCount, 0); b < parameters.bodyCount;
       b = nextNear(room, reach, step, parameters.bodyCount, b + 1)) {
    BodyStep body = bodyStep(step, parameters.bodyCount, b);
    uint buried = 0;
    while (buried < min(kMostBuried, count) &&
           bodyDistance(body.rest, placeAtStart(body, position(buried))).distance < -kOutside) ++buried;
    for (uint i = max(buried, parameters.rootCount); i < count; ++i) {
      vec3 v = solvedVelocity(i);
      Touch touch = traceParticle(body.rest, placeAtStart(body, position(i)), placeAtEnd(body, position(i) + T * v));
      bool isDeep = touch.surface.distance < -kDeep;
      vec3 n = outward(body, touch.surface.normal);
      if (isDeep) n = wayOutOfDepth(n, tangentAt(i));
      vec3 u = bodyVelocityAt(body, position(i), T);
      float target = dot(n, u) + leastParting(touch, T);
      float deficit = target - dot(n, v);
      if (!touch.found || !(deficit > 0.0)) continue;
      push(i, (isDeep ? kDeepShare : 1.0) * bodyWeight(mass(i), deficit), n, target, u, body.rest.friction);
      asked = true;
    }
    for (uint i = 0; i + 1 < count; ++i) {
      vec3 a = position(i);
      vec3 c = position(i + 1);
      vec3 va = solvedVelocity(i);
      vec3 vc = solvedVelocity(i + 1);
      Touch touch = traceEdge(body.rest, placeAtStart(body, a), placeAtEnd(body, a + T * va), placeAtStart(body, c),
                              placeAtEnd(body, c + T * vc));
      vec3 n = outward(body, touch.surface.normal);
      vec2 shares = vec2(1.0 - touch.along, touch.along);
      vec3 u = bodyVelocityAt(body, shares.x * a + shares.y * c, T);
      float deficit = dot(n, u) + leastParting(touch, T) - dot(n, shares.x * va + shares.y * vc);
      if (!touch.found || !(deficit > 0.0)) continue;
      vec2 part = shares * (deficit / dot(shares, shares));
      if (!isPinned(i) && shares.x >= kLeastShare)
        push(i, shares.x * bodyWeight(mass(i), deficit), n, dot(n, va) + part.x, u, body.rest.friction);
      if (!isPinned(i + 1) && shares.y >= kLeastShare)
        push(i + 1, shares.y * bodyWeight(mass(i + 1), deficit), n, dot(n, vc) + part.y, u, body.rest.friction);
      asked = true;
    }
  }
  return asked;
}

float normalMomentum(uint i) {
  vec4 normal = scratch[slot(i, kPushNormal)];
  return normal.w * (scratch[slot(i, kPushRest)].y - dot(normal.xyz, solvedVelocity(i)));
}
vec3 slidingVelocity(uint i) {
  vec3 n = scratchOf(i, kPushNormal);
  vec3 relative = solvedVelocity(i) - scratchOf(i, kPushBody);
  return relative - dot(n, relative) * n;
}

void addFriction() {
  for (uint i = parameters.rootCount; i < count; ++i) {
    vec3 n = scratchOf(i, kPushNormal);
    vec4 body = scratch[slot(i, kPushBody)];
    vec4 diagonal = scratch[slot(i, kPushWeight)];
    vec4 offDiagonal = scratch[slot(i, kPushWeight + 1)];
    vec4 rest = scratch[slot(i, kPushRest)];
    float weight = frictionWeight(slidingVelocity(i), normalMomentum(i), body.w, mass(i));
    Symmetric sum = addOuter(addDiagonal(Symmetric(diagonal.xyz, offDiagonal.xyz), weight), -weight, n);
    vec3 momentum = vec3(diagonal.w, offDiagonal.w, rest.x) + weight * (body.xyz - dot(n, body.xyz) * n);
    scratch[slot(i, kPushWeight)] = vec4(sum.d, momentum.x);
    scratch[slot(i, kPushWeight + 1)] = vec4(sum.o, momentum.y);
    scratch[slot(i, kPushRest)] = vec4(momentum.z, rest.y, weight, 0);
  }
}

void rubStrand() {
  for (uint i = parameters.rootCount; i < count; ++i) {
    setSolved(i, rubbed(solvedVelocity(i), slidingVelocity(i), scratch[slot(i, kPushRest)].z, normalMomentum(i),
                        scratch[slot(i, kPushBody)].w, mass(i)));
  }
}

void solveAmongBodies(uint step) {
  clearPushes();
  solveStrandBlock(step);
  if (!findPushes(step)) return;
  solveStrandBlock(step);
  addFriction();
  solveStrandBlock(step);
  rubStrand();
}

void keepOut(uint step) {
  float T = stepSeconds();
  Room room = emptyRoom();
  for (uint i = 0; i < count; ++i) {
    include(room, position(i));
    include(room, scratchOf(i, kStart));
  }
  for (uint b = nextNear(room, kTouchDistance, step, parameters.bodyCount, 0); b < parameters.bodyCount;
       b = nextNear(room, kTouchDistance, step, parameters.bodyCount, b + 1)) {
    BodyStep body = bodyStep(step, parameters.bodyCount, b);
    for (uint i = parameters.rootCount; i < count; ++i) {
      vec3 start = scratchOf(i, kStart);
      KeptOut kept = keptOut(body.rest, placeAtStart(body, start), placeAtEnd(body, position(i)));
      if (!kept.moved) continue;
      vec3 place = outOfBody(body, kept.place);
      vec3 n = outward(body, kept.normal);
      setVelocity(i, velocity(i) + slowedInward(velocity(i) - bodyVelocityAt(body, start, T), n,
                                                dot(n, place - position(i)), T));
      setPosition(i, place);
    }
  }
  // Edges: the shift of a particle's furthest edge, and the change of velocity that goes with it.
  for (uint i = 0; i < count; ++i) {
    setScratch(i, kShift, vec3(0));
    setScratch(i, kPushBody, vec3(0));
  }
  for (uint b = nextNear(room, kTouchDistance, step, parameters.bodyCount, 0); b < parameters.bodyCount;
       b = nextNear(room, kTouchDistance, step, parameters.bodyCount, b + 1)) {
    BodyStep body = bodyStep(step, parameters.bodyCount, b);
    for (uint i = 0; i + 1 < count; ++i) {
      EdgeSurface deepest = edgeDistance(body.rest, placeAtEnd(body, position(i)), placeAtEnd(body, position(i + 1)));
      if (!deepest.isWithin || deepest.surface.distance >= 0.0) continue;
      vec3 n = outward(body, deepest.surface.normal);
      vec2 shares = vec2(1.0 - deepest.along, deepest.along);
      vec2 part = shares / dot(shares, shares);
      float outBy = min(-deepest.surface.distance, kLeaveSpeed * T);
      vec3 start = shares.x * scratchOf(i, kStart) + shares.y * scratchOf(i + 1, kStart);
      vec3 v = shares.x * velocity(i) + shares.y * velocity(i + 1);
      vec3 slowed = slowedInward(v - bodyVelocityAt(body, start, T), n, outBy, T);
      for (uint side = 0; side < 2; ++side) {
        vec3 wanted = (part[side] * outBy) * n;
        vec3 before = scratchOf(i + side, kShift);
        if (isPinned(i + side) || dot(wanted, wanted) <= dot(before, before)) continue;
        setScratch(i + side, kShift, wanted);
        setScratch(i + side, kPushBody, part[side] * slowed);
      }
    }
  }
  for (uint i = parameters.rootCount; i < count; ++i) {
    setPosition(i, position(i) + scratchOf(i, kShift));
    setVelocity(i, velocity(i) + scratchOf(i, kPushBody));
  }
}

// Out of bodies, and edges no longer than allowed, in turn: what the one does may undo the other.
void keepAmongBodies(uint step) {
  keepOut(step);
  for (uint round = 1; round < kKeepOutRounds; ++round) {
    vec3 shift = vec3(0);
    bool limited = false;
    vec3 before = position(0);
    for (uint i = 1; i < count; ++i) {
      vec3 here = position(i);
      float share = isPinned(i) ? 0.0 : limitedEdgeShare(here - before, longestEdge(i - 1));
      limited = limited || share < 0.0;
      shift += share * (here - before);
      if (!isPinned(i)) setPosition(i, here + shift);
      before = here;
    }
    if (!limited) return;
    keepOut(step);
  }
}
