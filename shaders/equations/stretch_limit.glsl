// Stretch limit, Iben et al. 2012, section 3.1: the correction along an edge that is longer than allowed.
// Corrections are summed from root to tip, computed from the edges before limiting. Mirrored by
// reference/equations/stretch_limit.h.
#ifndef RINGLET_STRETCH_LIMIT
#define RINGLET_STRETCH_LIMIT

/// The correction as a factor of the edge: 0 if it is short enough, else negative.
float limitedEdgeShare(vec3 edge, float longest) {
  return min(0.0, longest * inversesqrt(max(dot(edge, edge), 1e-30)) - 1.0);
}

/// `paper` only: the change of velocity difference that limits the edge's rate to `fastest`.
vec3 limitedRateChange(vec3 velocityDifference, vec3 direction, float fastest) {
  return -max(0.0, dot(velocityDifference, direction) - fastest) * direction;
}

#endif
