// Smoothing along a strand, Iben et al. 2012, section 3.2.1, as a cascade of two exponential filters. The
// paper's expanded recurrence d_i = 2(1-β) d_{i-1} - (1-β)² d_{i-2} + β² e_i loses float32 digits on long
// strands; the cascade does not. The filters' factors β are left out, since many callers need only the
// direction; smoothed() applies them. Mirrored by reference/equations/smoothing.h.
#ifndef RINGLET_SMOOTHING
#define RINGLET_SMOOTHING

struct FilterState {
  vec3 a;  // after the first filter, divided by β
  vec3 d;  // after the second, divided by β²
};

// 1 - β, rounded; and β as 1 minus that, so that both add up to 1 and a constant stays constant. The rounding
// changes the smoothing length by a share of 3e-8 / β, which is visible after hundreds of explicit loops:
// these use β itself, at the cost of another operation.
float keptShare(float beta) { return 1.0 - beta; }
#ifdef RINGLET_EXACT_SMOOTHING
float takenShare(float beta) { return beta; }
#else
float takenShare(float beta) { return 1.0 - keptShare(beta); }
#endif

FilterState emptyFilter() { return FilterState(vec3(0), vec3(0)); }
/// The state after infinitely many values `start`.
FilterState startFilter(vec3 start, float beta) {
  vec3 a = start / takenShare(beta);
  return FilterState(a, a / takenShare(beta));
}

/// Filters the next value.
void smoothNext(inout FilterState s, vec3 x, float beta) {
#ifdef RINGLET_EXACT_SMOOTHING
  s.a += x - beta * s.a;
  s.d += s.a - beta * s.d;
#else
  s.a = keptShare(beta) * s.a + x;
  s.d = keptShare(beta) * s.d + s.a;
#endif
}

/// The smoothed value is this factor times d. beta = 1 returns the last value exactly.
float smoothedShare(float beta) { return takenShare(beta) * takenShare(beta); }
vec3 smoothed(FilterState s, float beta) { return smoothedShare(beta) * s.d; }

/// The state after n values that follow the state `before`; `alone`: the state that these values give from
/// zero. The filter is linear: n values of zero multiply the state by the matrix ((γⁿ, 0), (nγⁿ, γⁿ)), γ = 1
/// - β.
FilterState carryFilter(FilterState before, FilterState alone, float n, float gammaToN) {
  return FilterState(alone.a + gammaToN * before.a, alone.d + gammaToN * (before.d + n * before.a));
}

#endif
