// The terms of an edge in the implicit velocity solve (M + T C + T² K) v⁺ = M v + T f (our choice; the paper,
// section 5, uses explicit loops): the matrix across I + along ê êᵀ between its two particles. Mirrored by
// assembleSystem in reference/kernels/strand_step.h.
#ifndef RINGLET_IMPLICIT_EDGE
#define RINGLET_IMPLICIT_EDGE

/// Backward Euler itself damps by T k. This is subtracted from the bend damping, down to half of it, so that
/// motion does not depend on the step length. (In the reference: compensatedBendDamping in
/// reference/equations/bend_spring.h.)
float compensatedBendDamping(float damping, float stiffness, float T) {
  return max(damping - T * stiffness, 0.5 * damping);
}

struct ImplicitEdge {
  vec3 direction;  // ê; zero for an edge without length
  float along;     // stretch beyond bending [mass unit]
  float across;    // bending [mass unit]; positive for a real edge, 0 for a void one
};

/// T: step length; stiffness and damping per edge, bend damping compensated. Bending acts across the edge
/// only (eq. 3), hence the difference.
ImplicitEdge implicitEdge(vec3 direction, float T, float stretchStiffness, float stretchDamping, float bendStiffness,
                          float bendDamping) {
  float along = max(0.0, T * (stretchDamping + T * stretchStiffness - bendDamping));
  return ImplicitEdge(direction, along, T * (bendDamping + T * bendStiffness));
}

ImplicitEdge voidEdge() { return ImplicitEdge(vec3(1, 0, 0), 0.0, 0.0); }

vec3 multiply(ImplicitEdge edge, vec3 x) {
  return edge.across * x + edge.along * dot(edge.direction, x) * edge.direction;
}

#endif
