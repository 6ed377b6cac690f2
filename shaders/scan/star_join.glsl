// Joins the eliminations of lanes into the strand's exact solve (Redheffer's star product). Each lane has
// eliminated its own particles down to its particle 0, with its tip end free. Mirrored by
// reference/star_join.h.
//
// A system A describes the motion of a stretch of the strand: v_A is the velocity of its first particle, g
// the pull on it from rootward, f the force across the edge after its end, v_B the velocity of the first
// particle after that edge:
//   P v_A = y + g + Ψᵀ f          v_B = Ψ v_A + z + H f
// B, the system after it, is pulled by g = -f. With I = P_B⁻¹, the force across is f = Y (s - Ψ v_A), where Y
// = (I + H)⁻¹ and s = I y_B - z. Eliminating v_B and f gives the system of both stretches, which has the same
// form:
//   P  = P_A + Ψ_Aᵀ Y Ψ_A         y = y_A + Ψ_Aᵀ Y s
//   Ψ  = Ψ_B M                    v_B = M v_A + c,  M = I Y Ψ_A,  c = I (y_B - Y s),  B's own far force apart
//   z  = z_B + Ψ_B c              H = H_B + Ψ_B Z Ψ_Bᵀ,  Z = I - I Y I = I Y H_A
// Composition is associative: stretches may be grouped in any way. P, H, I, Y and Z are positive definite, and
// all sums of them are sums of positive matrices, so that float32 keeps its digits as in one serial sweep. A
// formulation in stiffnesses loses them from K_s = 1000 w on.
//
// The strand ends in a lane with Ψ = 0: nothing beyond has an effect, so the tip needs no special case.
#ifndef RINGLET_STAR_JOIN
#define RINGLET_STAR_JOIN

#include "maths/symmetric.glsl"
#include "scan/lanes.glsl"

// Doubling takes few rounds, but composing whole systems costs 2.4 times what carrying P and y on does. So
// stretches are doubled until four of them make up the strand, and P and y are carried over these four. With
// four lanes or fewer no systems are composed.
const uint kStretch = kLanes > 4 ? kLanes / 4 : 1;

struct LaneSystem {
  Symmetric P;  // mass units
  vec3 y;
  mat3 transfer;         // Ψ; 0 where the strand ends in this lane
  vec3 offset;           // z, without the pull of the boundary edge's springs
  Symmetric compliance;  // H, including that of the boundary edge
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

/// Adds the stretch that begins `lanes` lanes further on. Values of that lane are fetched where they are
/// used: all of them at once would not fit the registers of a GPU.
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

/// Carries P and y from each lane to the next rootward one; they then contain everything tipward of it.
Boundary joinLanes(LaneSystem system) {
  LaneSystem stretch = system;  // from this lane's particle 0 on, 1, 2, 4 ... lanes long
  [[unroll]] for (uint lanes = 1; lanes < kStretch; lanes *= 2) addStretchBeyond(stretch, lanes);

  Symmetric P = stretch.P;
  vec3 y = stretch.y;
  // Lane 0's own P and y are not needed. With stretches of one lane a last round would only compute these.
  [[unroll]] for (uint lanes = kStretch; lanes + 1 < kLanes; lanes += kStretch) {
    Boundary boundary = boundaryTo(fromTipward(P, kStretch), fromTipward(y, kStretch), stretch);
    mat3 YTransfer = multiply(boundary.Y, stretch.transfer);
    P = add(stretch.P, transposeMultiply(stretch.transfer, YTransfer));
    y = stretch.y + boundary.s * YTransfer;
  }
  return boundaryTo(fromTipward(P, 1), fromTipward(y, 1), system);
}

/// The velocity of this lane's particle 0, given the root's: composes the lanes' velocity maps from the root
/// on. The map of lane 0 is constant, so lanes without rootward neighbours need no special case.
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

/// The force across this lane's boundary.
vec3 boundaryForce(LaneSystem system, Boundary boundary, vec3 v) {
  return multiply(boundary.Y, boundary.s - system.transfer * v);
}

#endif
