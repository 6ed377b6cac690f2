// One step of the exact solve of a strand, from the tip: eliminates particle i+1 across edge i. It avoids
// subtraction where that matters: assembling A + P and inverting it would lose the mass to cancellation in
// float32. The reference uses plain block Cholesky in double: reference/strand_solve.h.
#ifndef RINGLET_ELIMINATE_EDGE
#define RINGLET_ELIMINATE_EDGE

#include "equations/implicit_edge.glsl"
#include "maths/symmetric.glsl"

struct Elimination {
  mat3 transfer;       // M: v_{i+1} = M v_i + z + Z (other pulls on i+1)
  vec3 offset;         // z
  Symmetric response;  // Z = (P_{i+1} + A)⁻¹
};

/// In: P and y of particle i+1 (P v = y + pull from i). Out: the same for particle i without its own mass and
/// right-hand side, which the caller adds.
Elimination eliminateEdge(ImplicitEdge edge, inout Symmetric P, inout vec3 y) {
  Symmetric inverseP = inverse(addDiagonal(P, edge.across));
  vec3 u = multiply(inverseP, edge.direction);
  float g = edge.along / (1.0 + edge.along * dot(edge.direction, u));
  vec3 q = multiply(P, u);
  vec3 Iy = multiply(inverseP, y);
  float gUy = g * dot(u, y);

  Elimination result;
  vec3 gu = g * u;
  mat3 spread = toMatrix(scale(inverseP, edge.across));
  result.transfer = mat3(spread[0] + gu * q.x, spread[1] + gu * q.y, spread[2] + gu * q.z);
  result.offset = Iy - gUy * u;
  result.response = addOuter(inverseP, -g, u);

  P = addOuter(scale(multiplyCommuting(inverseP, P), edge.across), g, q);
  y = edge.across * Iy + gUy * q;
  return result;
}

#endif
