// Stretch limit, Iben et al. 2012, section 3.1: what must be added to an edge that is longer than allowed, along the
// edge. The shifts are summed from the root to the tip, with the edges as they are before limiting. Mirrored by
// reference/equations/stretch_limit.h.
#ifndef RINGLET_STRETCH_LIMIT
#define RINGLET_STRETCH_LIMIT

/// As a factor of the edge: 0 where it is short enough, else negative.
float limitedEdgeShare(vec3 edge, float longest) {
  return min(0.0, longest * inversesqrt(max(dot(edge, edge), 1e-30)) - 1.0);
}

/// `paper` only: the change of velocity difference that keeps the edge's rate at or below `fastest`.
vec3 limitedRateChange(vec3 velocityDifference, vec3 direction, float fastest) {
  return -max(0.0, dot(velocityDifference, direction) - fastest) * direction;
}

#endif
