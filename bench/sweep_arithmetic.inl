// The arithmetic of the sweeps, that of shaders/kernels/strand_step.comp with one lane a strand; the
// equations' words are explained there. Included twice, in a namespace that has V, a number of each of some
// strands: hand_sweeps.cpp, eight floats; operation_count.cpp, one that counts. V comes with load, store,
// all, max, min, inverseSqrt, inverse, wherePositive, loadBlock and storeBlock.
//
// A step is two sweeps. Root to tip: what the solve of the step before found moves the strand, and at once
// the springs of the next step follow, particle by particle. Tip to root: the core's forces go back on the
// edges, and the strand's system is eliminated.

void loadBlock(const SweepRun& run, const Block& block, EdgeWork* work);
void storeBlock(const SweepRun& run, const Block& block, const EdgeWork* work);

struct V3 {
  V x, y, z;
};
inline V3 operator+(V3 a, V3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline V3 operator-(V3 a, V3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline V3 operator*(V s, V3 a) { return {s * a.x, s * a.y, s * a.z}; }
inline V dot(V3 a, V3 b) { return a.x * b.x + (a.y * b.y + a.z * b.z); }
inline V3 cross(V3 a, V3 b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
inline V3 load(const Eight (&a)[3]) { return {load(a[0]), load(a[1]), load(a[2])}; }
inline V3 load3(const Eight* a) { return {load(a[0]), load(a[1]), load(a[2])}; }
inline void store3(Eight* to, V3 a) {
  store(to[0], a.x);
  store(to[1], a.y);
  store(to[2], a.z);
}
inline V3 all(const layout::vec3& a) { return {all(a.x), all(a.y), all(a.z)}; }
inline V3 all(const layout::vec4& a) { return {all(a.x), all(a.y), all(a.z)}; }

struct Q {
  V x, y, z, w;
  V3 imaginary() const { return {x, y, z}; }
};
inline Q allQ(const layout::vec4& q) { return {all(q.x), all(q.y), all(q.z), all(q.w)}; }
inline Q conjugate(Q q) { return {-q.x, -q.y, -q.z, q.w}; }
inline V3 displacement(Q q, V3 x) {
  const V3 c = cross(q.imaginary(), x), t = c + c;
  return q.w * t + cross(q.imaginary(), t);
}
inline V3 rotate(Q q, V3 x) { return x + displacement(q, x); }
// `frame` turned by a turn less the identity.
inline Q turned(Q turn, Q frame) {
  const V3 i =
      turn.w * frame.imaginary() + (frame.w * turn.imaginary() + cross(turn.imaginary(), frame.imaginary()));
  const V w = turn.w * frame.w - dot(turn.imaginary(), frame.imaginary());
  return {frame.x + i.x, frame.y + i.y, frame.z + i.z, frame.w + w};
}
inline Q renormalized(Q q) {
  const V s = 1.5f - 0.5f * (q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
  return {s * q.x, s * q.y, s * q.z, s * q.w};
}
// The smallest rotation from the unit vector a to b, less the identity.
inline Q smallestTurn(V3 a, V3 b) {
  const V3 axis = cross(a, b);
  const V c = 1.0f + dot(a, b);
  const V s = inverseSqrt(max(dot(axis, axis) + c * c, all(1e-20f)));
  const V3 i = s * axis;
  return {i.x, i.y, i.z, -dot(i, i) * inverse(1.0f + c * s)};
}

struct Filter {
  V3 a, d;
};
inline void smoothNext(Filter& f, V3 x, V beta) {
  f.a = f.a + beta * (x - f.a);
  f.d = f.d + beta * (f.a - f.d);
}

struct Symmetric {
  V xx, yy, zz, yz, xz, xy;
};
inline V3 operator*(const Symmetric& a, V3 x) {
  return {a.xx * x.x + (a.xy * x.y + a.xz * x.z), a.xy * x.x + (a.yy * x.y + a.yz * x.z),
          a.xz * x.x + (a.yz * x.y + a.zz * x.z)};
}
inline Symmetric scaled(const Symmetric& a, V s) {
  return {s * a.xx, s * a.yy, s * a.zz, s * a.yz, s * a.xz, s * a.xy};
}
inline Symmetric inverse(const Symmetric& a) {
  const V xx = a.yy * a.zz - a.yz * a.yz, yy = a.xx * a.zz - a.xz * a.xz, zz = a.xx * a.yy - a.xy * a.xy;
  const V yz = a.xz * a.xy - a.xx * a.yz, xz = a.yz * a.xy - a.yy * a.xz, xy = a.yz * a.xz - a.zz * a.xy;
  return scaled({xx, yy, zz, yz, xz, xy}, inverse(a.xx * xx + (a.xy * xy + a.xz * xz)));
}
// a b, known to be symmetric.
inline Symmetric multiplyCommuting(const Symmetric& a, const Symmetric& b) {
  return {a.xx * b.xx + (a.xy * b.xy + a.xz * b.xz), a.yy * b.yy + (a.xy * b.xy + a.yz * b.yz),
          a.zz * b.zz + (a.xz * b.xz + a.yz * b.yz), a.xy * b.xz + (a.yy * b.yz + a.yz * b.zz),
          a.xx * b.xz + (a.xy * b.yz + a.xz * b.zz), a.xx * b.xy + (a.xy * b.yy + a.xz * b.yz)};
}

// What the head does in a step, beside what it does to a strand.
struct Head {
  Q rotation, turnBefore, turn, rotationNext;
  V3 velocityChange;
};
inline Head headIn(const SweepRun& run, std::uint32_t step) {
  const layout::StepPose &now = run.poses[step], &next = run.poses[step + 1];
  return {allQ(now.rotation), allQ(now.turn), allQ(next.turn), allQ(next.rotation), all(next.velocityChange)};
}

constexpr std::size_t kCore = 0, kDirection = 3, kRightHandSide = 6;  // of `work`, root to tip
constexpr std::size_t kTransfer = 0, kOffset = 9;                     // tip to root
constexpr std::size_t kVelocity = 0;                                  // before the first step, after the last

// What a sweep hands on.
struct Sums {
  V coreLength = {}, maxStretch = {};
};

// Springs from root to tip: edge by edge, as particles come.
template <bool kOneSmoothing>
struct Springs {
  const StrandsRest& strands;
  V T;
  V3 gravity;
  Filter bend, core, velocity;
  V3 direction, forceBefore = {};
  Q frame;

  Springs(const SweepRun& run, const StrandsRest& rest, const Head& head)
      : strands(rest), T(all(run.gravity.w)), gravity(all(run.gravity)), frame(head.rotation) {
    const V3 edge = rotate(head.rotation, load(rest.firstEdge));
    const V3 turning = all(-1 / run.gravity.w) * displacement(conjugate(head.turnBefore), edge);
    bend = core = {edge, edge};
    velocity = {turning, turning};
    direction = inverseSqrt(max(dot(edge, edge), all(1e-30f))) * edge;
  }

  // Edge i; v: of particle i.
  [[gnu::always_inline]] void next(std::uint32_t i, const EdgeRest& rest, V3 e, V3 v, V3 dv, EdgeWork& work,
                                   Sums& sums) {
    const V scale = load(rest.scale), squared = dot(e, e), perLength = inverseSqrt(max(squared, all(1e-30f)));
    const V length = squared * perLength;
    const V3 eHat = perLength * e;
    store3(work.work + kDirection, eHat);
    sums.maxStretch = max(sums.maxStretch, length * scale);

    smoothNext(bend, e, load(strands.bendBeta));
    smoothNext(velocity, dv, load(strands.coreBeta));
    const V bendSquared = dot(bend.d, bend.d), perBend = inverseSqrt(max(bendSquared, all(1e-30f)));
    const V3 to = perBend * bend.d;
    V coreLength = bendSquared * perBend;
    V3 coreDirection = to;
    if (!kOneSmoothing) {
      smoothNext(core, e, load(strands.coreBeta));
      const V coreSquared = dot(core.d, core.d), perCore = inverseSqrt(max(coreSquared, all(1e-30f)));
      coreLength = coreSquared * perCore;
      coreDirection = perCore * core.d;
    }
    const V h = scale * (load(strands.coreStiffness) * (coreLength - load(rest.coreLength)) +
                         load(strands.coreDamping) * dot(velocity.d, coreDirection));
    store3(work.work + kCore, h * coreDirection);
    sums.coreLength += wherePositive(scale, coreLength);

    const V3 target = rotate(frame, load(rest.target));
    frame = turned(smallestTurn(direction, to), frame);
    if (i % 16 == 15) frame = renormalized(frame);
    direction = to;
    const V stretch = load(strands.stretchStiffness) * scale * (length - load(rest.restLength));
    const V3 force = stretch * eHat + load(strands.bendStiffness) * scale * (e - target);
    store3(work.work + kRightHandSide, rightHandSide(load(rest.mass), v, force));
    forceBefore = force;
  }

  // m v + T (f_i - f_{i-1} + m g), without the core's.
  [[gnu::always_inline]] V3 rightHandSide(V mass, V3 v, V3 force) const {
    return mass * (v + T * gravity) + T * (force - forceBefore);
  }
};

// Root to tip. kMoves: the solve of step - 1 is in `work`; kSprings: step follows.
template <bool kOneSmoothing, bool kMoves, bool kSprings>
void sweepOut(const SweepRun& run, const Block& block, std::uint32_t step, EdgeWork* work, Sums& sums) {
  const StrandsRest& strands = *block.strands;
  const V T = all(run.gravity.w), perT = all(1 / run.gravity.w);
  const Head moving = headIn(run, kMoves ? step - 1 : 0), head = headIn(run, kSprings ? step : 0);
  Springs<kOneSmoothing> springs(run, strands, head);

  V3 solvedBefore{}, oldBefore{}, shift{}, before{}, velocityBefore{};
  for (std::uint32_t i = 0; i < block.longest; ++i) {
    const V3 old = load(work[i].position);
    V3 p = old, v;
    if (!kMoves) {
      v = load3(work[i].work + kVelocity);
    } else if (i < run.rootCount) {
      const V3 pin = load(strands.pins[i]);
      solvedBefore = v = perT * displacement(moving.turn, rotate(moving.rotation, pin));
      p = rotate(moving.rotationNext, pin);
      store3(work[i].position, p);
    } else {
      const Eight* M = work[i - 1].work + kTransfer;
      v = load3(work[i - 1].work + kOffset) +
          (solvedBefore.x * load3(M) + (solvedBefore.y * load3(M + 3) + solvedBefore.z * load3(M + 6)));
      const V3 moved = (old - oldBefore) + T * (v - solvedBefore);
      const V share = min(
          all(0), load(block.edges[i - 1].longest) * inverseSqrt(max(dot(moved, moved), all(1e-30f))) - 1.0f);
      shift = shift + share * moved;
      p = old + T * v + shift;
      store3(work[i].position, p);
      solvedBefore = v;
      v = v + perT * shift;
    }
    oldBefore = old;
    if (kSprings) v = v - head.velocityChange;
    if (i > 0 && kSprings)
      springs.next(i - 1, block.edges[i - 1], p - before, velocityBefore, v - velocityBefore, work[i - 1],
                   sums);
    if (i > 0 && !kSprings) {
      const V3 e = p - before;
      const V squared = dot(e, e);
      sums.maxStretch = max(
          sums.maxStretch, squared * inverseSqrt(max(squared, all(1e-30f))) * load(block.edges[i - 1].scale));
      store3(work[i - 1].work + kVelocity, velocityBefore);
    }
    before = p;
    velocityBefore = v;
  }
  EdgeWork& tip = work[block.longest - 1];
  if (kSprings) {
    store3(tip.work + kRightHandSide,
           springs.rightHandSide(load(block.edges[block.longest - 1].mass), velocityBefore, V3{}));
  } else {
    store3(tip.work + kVelocity, velocityBefore);
  }
}

// The share of the core's constants in force.
inline V coreBlend(const SweepRun& run, V elongation) {
  const V low = all(run.coreElongationLow), span = all(run.coreElongationHigh) - low;
  const V s = min(max((elongation - low) / span, all(0)), all(1));
  return run.coreRelaxedShare + (1 - run.coreRelaxedShare) * (s * s * (3.0f - 2.0f * s));
}

// Tip to root: eliminates particle i + 1 across edge i (equations/eliminate_edge.glsl).
void sweepBack(const SweepRun& run, const Block& block, V coreLength, EdgeWork* work) {
  const StrandsRest& strands = *block.strands;
  const V beta = load(strands.coreBeta), acrossOf = load(strands.across), alongOf = load(strands.along);
  const V coreScale = all(run.gravity.w) * coreBlend(run, coreLength * load(strands.perCoreLength));
  const std::uint32_t tip = block.longest - 1;
  Filter core{};
  V3 y = load3(work[tip].work + kRightHandSide);
  const V tipMass = load(block.edges[tip].mass);
  Symmetric P{tipMass, tipMass, tipMass, {}, {}, {}};
  for (std::uint32_t i = tip; i-- > run.rootCount - 1;) {
    const EdgeRest& rest = block.edges[i];
    Eight* record = work[i].work;
    smoothNext(core, load3(record + kCore), beta);
    const V3 coreForce = coreScale * core.d;
    y = y - coreForce;

    const V across = acrossOf * load(rest.scale), along = alongOf * load(rest.scale);
    const V3 direction = load3(record + kDirection);
    const Symmetric inverseP =
        inverse(Symmetric{P.xx + across, P.yy + across, P.zz + across, P.yz, P.xz, P.xy});
    const V3 u = inverseP * direction;
    const V g = along * inverse(1.0f + along * dot(direction, u));
    const V3 q = P * u, Iy = inverseP * y, gu = g * u, gq = g * q;
    const V gUy = g * dot(u, y);
    const Symmetric spread = scaled(inverseP, across);
    const V3 rightHandSide = load3(record + kRightHandSide);
    store3(record + kTransfer, V3{spread.xx, spread.xy, spread.xz} + q.x * gu);
    store3(record + kTransfer + 3, V3{spread.xy, spread.yy, spread.yz} + q.y * gu);
    store3(record + kTransfer + 6, V3{spread.xz, spread.yz, spread.zz} + q.z * gu);
    store3(record + kOffset, Iy - gUy * u);

    const Symmetric C = multiplyCommuting(spread, P);
    const V mass = load(rest.mass);
    P = {C.xx + (gq.x * q.x + mass), C.yy + (gq.y * q.y + mass), C.zz + (gq.z * q.z + mass),
         C.yz + gq.y * q.z,          C.xz + gq.x * q.z,          C.xy + gq.x * q.y};
    y = across * Iy + gUy * q + (rightHandSide + coreForce);
  }
}

template <bool kOneSmoothing>
V runSteps(const SweepRun& run, const Block& block, EdgeWork* work) {
  loadBlock(run, block, work);
  Sums sums;
  sweepOut<kOneSmoothing, false, true>(run, block, 0, work, sums);
  for (std::uint32_t step = 1; step < run.steps; ++step) {
    sweepBack(run, block, sums.coreLength, work);
    sums.coreLength = V{};
    sweepOut<kOneSmoothing, true, true>(run, block, step, work, sums);
  }
  sweepBack(run, block, sums.coreLength, work);
  sweepOut<kOneSmoothing, true, false>(run, block, run.steps, work, sums);
  storeBlock(run, block, work);
  return sums.maxStretch;
}
inline V runStepsOf(const SweepRun& run, const Block& block, EdgeWork* work) {
  return run.oneSmoothing ? runSteps<true>(run, block, work) : runSteps<false>(run, block, work);
}
