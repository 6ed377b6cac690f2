// The residual of the velocity solve over the strand's free particles. Included by kernels/strand_step.comp;
// compiled in only if it is asked for.
#ifndef RINGLET_RESIDUAL
#define RINGLET_RESIDUAL

#include "equations/implicit_edge.glsl"
#include "equations/velocity_residual.glsl"
#include "integrators/jacobi.glsl"
#include "shared/strand_run.glsl"

void measureResidual() {
  vec3 forceBefore = forceFromRootward();
  vec3 vBefore = fromRootward(v[RUN - 1], 1);
  vec3 vNext = fromTipward(v[0], 1);
  ImplicitEdge last = implicitEdgeOf(RUN - 1);
  ImplicitEdge rootwardEdge = ImplicitEdge(fromRootward(last.direction, 1), fromRootward(last.along, 1),
      fromRootward(last.across, 1));
  if (lane == 0) rootwardEdge = voidEdge();
  float residualSquared = 0.0;
  float scaleSquared = 0.0;
  RINGLET_OVER_RUN for (int k = 0; k < runEnd; ++k) {
    vec3 rhs = rightHandSide(k, vStart[k], k > 0 ? force[max(k - 1, 0)] : forceBefore);
    ImplicitEdge edge = implicitEdgeOf(k);
    vec3 residual = rhs - restEdge[k].x * v[k];
    residual += multiply(edge, (k + 1 < RUN ? v[min(k + 1, RUN - 1)] : vNext) - v[k]);
    residual += multiply(rootwardEdge, (k > 0 ? v[max(k - 1, 0)] : vBefore) - v[k]);
    rootwardEdge = edge;
    residualSquared += isFree(k) ? dot(residual, residual) : 0.0;
    scaleSquared += isFree(k) ? residualScaleSquared(rhs, restEdge[k].x, stepSeconds()) : 0.0;
  }
  velocityResidual =
      max(velocityResidual, velocityResidualShare(sumOverStrand(residualSquared), sumOverStrand(scaleSquared)));
}

#endif
