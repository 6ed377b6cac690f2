// Smoothing along a strand, Iben et al. 2012, section 3.2.1, as a cascade of two exponential filters: the paper's
// expanded recurrence d_i = 2(1-β) d_{i-1} - (1-β)² d_{i-2} + β² e_i loses float32 digits on long strands, this does not.
// Mirrored by reference/equations/smoothing.h.
#ifndef RINGLET_SMOOTHING
#define RINGLET_SMOOTHING

struct FilterState {
  vec3 a;  // after the first filter
  vec3 d;  // after the second: the smoothed value
};

FilterState startFilter(vec3 start) { return FilterState(start, start); }

/// Takes in the next value. beta = 1 returns it exactly.
void smoothNext(inout FilterState s, vec3 x, float beta) {
  s.a += beta * (x - s.a);
  s.d += beta * (s.a - s.d);
}

/// The state n values after `before`, where `alone` is the state those n values give from zero. The filter is linear:
/// zero input over n values is the matrix ((γⁿ, 0), (nβγⁿ, γⁿ)), γ = 1 - β.
FilterState carryFilter(FilterState before, FilterState alone, float nBeta, float gammaToN) {
  return FilterState(alone.a + gammaToN * before.a, alone.d + gammaToN * (before.d + nBeta * before.a));
}

#endif
