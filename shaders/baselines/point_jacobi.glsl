// `point_jacobi`, with the particle as block: a fixed number of Jacobi iterations on the same implicit
// system, plain or Chebyshev-accelerated. It iterates on residuals and changes: the float32 error of an
// inverse then slows the iteration instead of changing its limit, and Chebyshev's recurrence accumulates
// rounding of the change and not of the velocity. It is a baseline, and a check of the strand block. Included
// by kernels/strand_step.comp.
#ifndef RINGLET_POINT_JACOBI
#define RINGLET_POINT_JACOBI

#include "equations/chebyshev_weight.glsl"
#include "equations/implicit_edge.glsl"
#include "integrators/jacobi.glsl"
#include "maths/symmetric.glsl"
#include "shared/strand_run.glsl"

void iteratePointJacobi(vec3 pinned[3]) {
  ImplicitEdge edge[RUN];
  vec3 rhs[RUN];
  Symmetric inverseDiagonal[RUN];
  vec3 change[RUN];

  vec3 forceBefore = forceFromRootward();
  RINGLET_OVER_RUN for (int k = 0; k < runEnd; ++k) {
    edge[k] = implicitEdgeOf(k);
    rhs[k] = rightHandSide(k, v[k], k > 0 ? force[max(k - 1, 0)] : forceBefore);
  }
  ImplicitEdge edgeBefore = ImplicitEdge(fromRootward(edge[RUN - 1].direction, 1), fromRootward(edge[RUN - 1].along, 1),
                                         fromRootward(edge[RUN - 1].across, 1));
  if (lane == 0) edgeBefore = voidEdge();
  RINGLET_OVER_RUN for (int k = 0; k < runEnd; ++k) {
    ImplicitEdge before = k > 0 ? edge[max(k - 1, 0)] : edgeBefore;
    Symmetric D = symmetricDiagonal(restEdge[k].x + edge[k].across + before.across);
    D = addOuter(addOuter(D, edge[k].along, edge[k].direction), before.along, before.direction);
    inverseDiagonal[k] = inverse(D);
    if (isPinned(k)) v[k] = pinned[min(k, 2)];
    change[k] = vec3(0);
  }

  float omega = 1.0;
  for (uint iteration = 0; iteration < numbers.pointIterations; ++iteration) {
    if (numbers.chebyshev != 0 && iteration > 0) {
      omega = chebyshevWeight(iteration, omega, strand.jacobiGap);
    }
    vec3 vBefore = fromRootward(v[RUN - 1], 1);
    vec3 vNext = fromTipward(v[0], 1);
    vec3 rootwardNow = vBefore;
    RINGLET_OVER_RUN for (int k = 0; k < runEnd; ++k) {
      vec3 tipwardNow = k + 1 < RUN ? v[min(k + 1, RUN - 1)] : vNext;
      ImplicitEdge before = k > 0 ? edge[max(k - 1, 0)] : edgeBefore;
      vec3 now = v[k];
      vec3 residual = rhs[k] - restEdge[k].x * now + multiply(edge[k], tipwardNow - now) +
                      multiply(before, rootwardNow - now);
      change[k] = (omega - 1.0) * change[k] + omega * multiply(inverseDiagonal[k], residual);
      if (isFree(k)) v[k] = now + change[k];
      rootwardNow = now;
    }
  }
}

#endif
