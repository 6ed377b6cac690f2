// Smoothing along a strand, Iben et al. 2012, section 3.2.1, as a cascade of two exponential filters: the paper's
// expanded recurrence d_i = 2(1-β) d_{i-1} - (1-β)² d_{i-2} + β² e_i loses float32 digits on long strands, this does
// not. The filters' factors β are left out, as many take only the direction; smoothed() puts them in. Mirrored by
// reference/equations/smoothing.h.
#ifndef RINGLET_SMOOTHING
#define RINGLET_SMOOTHING

struct FilterState {
  vec3 a;  // after the first filter, over β
  vec3 d;  // after the second, over β²
};

// 1 - β, rounded; and β once more, so that both add up to 1 and a constant stays what it is. What the rounding does to
// the smoothing length, 3e-8 / β of it, hundreds of explicit loops show: for them, with β itself and an operation more.
float keptShare(float beta) { return 1.0 - beta; }
#ifdef RINGLET_EXACT_SMOOTHING
float takenShare(float beta) { return beta; }
#else
float takenShare(float beta) { return 1.0 - keptShare(beta); }
#endif

FilterState emptyFilter() { return FilterState(vec3(0), vec3(0)); }
/// The state after `start` for ever.
FilterState startFilter(vec3 start, float beta) {
  vec3 a = start / takenShare(beta);
  return FilterState(a, a / takenShare(beta));
}

/// Takes in the next value.
void smoothNext(inout FilterState s, vec3 x, float beta) {
#ifdef RINGLET_EXACT_SMOOTHING
  s.a += x - beta * s.a;
  s.d += s.a - beta * s.d;
#else
  s.a = keptShare(beta) * s.a + x;
  s.d = keptShare(beta) * s.d + s.a;
#endif
}

/// The smoothed value is this times d. beta = 1 returns the last value exactly.
float smoothedShare(float beta) { return takenShare(beta) * takenShare(beta); }
vec3 smoothed(FilterState s, float beta) { return smoothedShare(beta) * s.d; }

/// The state n values after `before`, where `alone` is the state those n values give from zero. The filter is linear:
/// zero input over n values is the matrix ((γⁿ, 0), (nγⁿ, γⁿ)), γ = 1 - β.
FilterState carryFilter(FilterState before, FilterState alone, float n, float gammaToN) {
  return FilterState(alone.a + gammaToN * before.a, alone.d + gammaToN * (before.d + n * before.a));
}

#endif
