// Joins the lanes' eliminations into the strand's exact solve (Redheffer's star product). Each lane has eliminated its
// own particles down to its particle 0, with its tip end free. Mirrored by reference/star_join.h.
//
// A system A says how a stretch of the strand moves: v_A is the velocity of its first particle, g the pull on that from
// rootward, f the force across the edge beyond its end, v_B the velocity of the first particle beyond it:
//   P v_A = y + g + Ψᵀ f          v_B = Ψ v_A + z + H f
// B, the system beyond, feels g = -f. With I = P_B⁻¹, the force across is f = Y (s - Ψ v_A), where Y = (I + H)⁻¹ and
// s = I y_B - z. Eliminating v_B and f gives the system of both stretches, which is of the same kind:
//   P  = P_A + Ψ_Aᵀ Y Ψ_A         y = y_A + Ψ_Aᵀ Y s
//   Ψ  = Ψ_B M                    v_B = M v_A + c,  M = I Y Ψ_A,  c = I (y_B - Y s),  B's own far force apart
//   z  = z_B + Ψ_B c              H = H_B + Ψ_B Z Ψ_Bᵀ,  Z = I - I Y I = I Y H_A
// Composing is associative: stretches may be grouped in any way. P, H, I, Y and Z are positive definite and all sums
// of them are sums of positive matrices, so that float32 keeps its digits as in one serial sweep. A form in
// stiffnesses does not, from K_s = 1000 w on.
//
// The strand ends in a lane whose Ψ is 0: nothing beyond is felt, so no case is needed for the tip.
#ifndef RINGLET_STAR_JOIN
#define RINGLET_STAR_JOIN

#include "maths/symmetric.glsl"
#include "scan/lanes.glsl"

// Doubling takes few rounds, but composing whole systems costs 2.4 times what carrying P and y on does. So stretches
// are doubled until four of them make the strand, and P and y are carried over these four. With four lanes or fewer
// no system is composed.
const uint kStretch = kLanes > 4 ? kLanes / 4 : 1;

struct LaneSystem {
  Symmetric P;  // mass units
  vec3 y;
  mat3 transfer;         // Ψ; 0 where the strand ends in this lane
  vec3 offset;           // z, less what the boundary edge's springs pull
  Symmetric compliance;  // H, the boundary edge's own included
};

struct Boundary {
  Symmetric inversePBeyond;  // I
  vec3 yBeyond;              // y_B
  Symmetric Y;
  vec3 s;
};

struct VelocityMap {  // v_B = M v_A + c
  mat3 M;
  vec3 c;
};

Symmetric fromTipward(Symmetric a, uint offset) {
  return Symmetric(fromTipward(a.d, offset), fromTipward(a.o, offset));
}
mat3 fromTipward(mat3 a, uint offset) {
  return mat3(fromTipward(a[0], offset), fromTipward(a[1], offset), fromTipward(a[2], offset));
}
mat3 fromRootward(mat3 a, uint offset) {
  return mat3(fromRootward(a[0], offset), fromRootward(a[1], offset), fromRootward(a[2], offset));
}

Boundary boundaryTo(Symmetric PBeyond, vec3 yBeyond, LaneSystem a) {
  Boundary b;
  b.inversePBeyond = inverse(PBeyond);
  b.yBeyond = yBeyond;
  b.Y = inverse(add(b.inversePBeyond, a.compliance));
  b.s = multiply(b.inversePBeyond, yBeyond) - a.offset;
  return b;
}

VelocityMap velocityMap(Boundary b, mat3 YTransfer) {
  return VelocityMap(multiply(b.inversePBeyond, YTransfer),
                     multiply(b.inversePBeyond, b.yBeyond - multiply(b.Y, b.s)));
}

/// Adds the stretch that begins `lanes` lanes on. What that lane has is fetched where it is used: all of it at once
/// would not fit the registers of a GPU.
void addStretchBeyond(inout LaneSystem a, uint lanes) {
  Boundary b = boundaryTo(fromTipward(a.P, lanes), fromTipward(a.y, lanes), a);
  mat3 YTransfer = multiply(b.Y, a.transfer);
  a.P = add(a.P, transposeMultiply(a.transfer, YTransfer));
  a.y += b.s * YTransfer;  // (Y Ψ)ᵀ s
  VelocityMap map = velocityMap(b, YTransfer);
  Symmetric Z = symmetricProduct(multiply(b.inversePBeyond, toMatrix(b.Y)), a.compliance);

  mat3 transferBeyond = fromTipward(a.transfer, lanes);
  a.transfer = transferBeyond * map.M;
  a.offset = fromTipward(a.offset, lanes) + transferBeyond * map.c;
  mat3 transposed = transpose(transferBeyond);
  a.compliance = add(fromTipward(a.compliance, lanes), transposeMultiply(transposed, multiply(Z, transposed)));
}

/// From each lane to the next, whose P and y then hold all that lies tipward.
Boundary joinLanes(LaneSystem system) {
  LaneSystem stretch = system;  // from this lane's particle 0 on, 1, 2, 4 ... lanes long
  [[unroll]] for (uint lanes = 1; lanes < kStretch; lanes *= 2) addStretchBeyond(stretch, lanes);

  Symmetric P = stretch.P;
  vec3 y = stretch.y;
  // Lane 0's own P and y are not needed. With stretches of one lane a last round would find only these.
  [[unroll]] for (uint lanes = kStretch; lanes + 1 < kLanes; lanes += kStretch) {
    Boundary boundary = boundaryTo(fromTipward(P, kStretch), fromTipward(y, kStretch), stretch);
    mat3 YTransfer = multiply(boundary.Y, stretch.transfer);
    P = add(stretch.P, transposeMultiply(stretch.transfer, YTransfer));
    y = stretch.y + boundary.s * YTransfer;
  }
  return boundaryTo(fromTipward(P, 1), fromTipward(y, 1), system);
}

/// The velocity of this lane's particle 0, from the root's: the lanes' maps to the next composed from the root on. That
/// of lane 0 ignores what it is given, so that lanes with nothing rootward need no case.
vec3 velocityFromRoot(LaneSystem system, Boundary boundary, vec3 rootVelocity) {
  VelocityMap map = velocityMap(boundary, multiply(boundary.Y, system.transfer));
  if (lane == 0) map = VelocityMap(mat3(0), map.M * rootVelocity + map.c);
  [[unroll]] for (uint lanes = 1; lanes < kStretch; lanes *= 2) {
    map.c += map.M * fromRootward(map.c, lanes);
    map.M = map.M * fromRootward(map.M, lanes);
  }
  vec3 next = map.c;
  [[unroll]] for (uint lanes = kStretch; lanes + 1 < kLanes; lanes += kStretch)
    next = map.M * fromRootward(next, kStretch) + map.c;
  vec3 arrived = fromRootward(next, 1);
  return lane == 0 ? rootVelocity : arrived;
}

/// Across this lane's boundary.
vec3 boundaryForce(LaneSystem system, Boundary boundary, vec3 v) {
  return multiply(boundary.Y, boundary.s - system.transfer * v);
}

#endif
