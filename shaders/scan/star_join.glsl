// Joins the lanes' eliminations into the strand's exact solve. Each lane has eliminated its own particles down to its
// particle 0, with its tip end free; a lane's boundary edge to the next lane is a compliance H, and everything joined is a
// mass, a transfer or a compliance, all positive: as exact in float32 as one serial sweep. (Redheffer's star product;
// a form in stiffnesses fails quietly from K_s = 1000 w on.)
//
//   next lane's v_0 = Ψ v_0 + z + H f        force across the boundary, its springs and all:  f = Y (s - Ψ v_0)
#ifndef RINGLET_STAR_JOIN
#define RINGLET_STAR_JOIN

#include "maths/symmetric.glsl"
#include "scan/lanes.glsl"

struct LaneSystem {
  Symmetric P;  // of the lane's particle 0, without what lies beyond the boundary
  vec3 y;
  mat3 transfer;         // Ψ
  vec3 offset;           // z, less what the boundary edge's springs pull
  Symmetric compliance;  // H, the boundary edge's own included
  bool joined;           // the boundary edge is real: the strand goes on in the next lane
};

struct Boundary {
  Symmetric Y;
  vec3 s;
  Symmetric inversePNext;  // P⁻¹ of the next lane's particle 0, and its y
  vec3 yNext;
};

Boundary boundaryTo(Symmetric PNext, vec3 yNext, LaneSystem system) {
  Boundary b;
  b.inversePNext = inverse(PNext);
  b.yNext = yNext;
  b.Y = inverse(add(b.inversePNext, system.compliance));
  b.s = multiply(b.inversePNext, yNext) - system.offset;
  return b;
}

/// The next lane's P and y come to rest from the tip, one lane a round: kLanes - 1 rounds, for few lanes.
Boundary joinLanes(LaneSystem system) {
  Symmetric P = system.P;
  vec3 y = system.y;
  Boundary boundary;
  [[unroll]] for (uint round = 1; round < kLanes; ++round) {
    Symmetric PNext = Symmetric(fromTipward(P.d, 1), fromTipward(P.o, 1));
    vec3 yNext = fromTipward(y, 1);
    boundary = boundaryTo(PNext, yNext, system);
    if (system.joined) {
      mat3 YTransfer = multiply(boundary.Y, system.transfer);
      P = add(system.P, transposeMultiply(system.transfer, YTransfer));
      y = system.y + boundary.s * YTransfer;  // (Y Ψ)ᵀ s
    }
  }
  return boundary;
}

/// From the root's velocity to every lane's particle 0, whose velocity is `v`. Returns f, the force across this lane's boundary.
vec3 solveBoundaries(LaneSystem system, Boundary boundary, inout vec3 v) {
  vec3 f = vec3(0);
  [[unroll]] for (uint round = 0; round < kLanes; ++round) {
    f = system.joined ? multiply(boundary.Y, boundary.s - system.transfer * v) : vec3(0);
    if (round + 1 == kLanes) break;
    vec3 vNext = multiply(boundary.inversePNext, boundary.yNext - f);
    vec3 arrived = fromRootward(vNext, 1);
    if (lane > 0) v = arrived;
  }
  return f;
}

#endif
