// Carries the smoothing filter across lanes: from each lane's end state to the state in which the next lane
// starts.
#ifndef RINGLET_FILTER_SCAN
#define RINGLET_FILTER_SCAN

#include "equations/smoothing.glsl"
#include "scan/lanes.glsl"

/// γ^RUN by squaring, from RUN's highest bit down, which is the initial g (pow() would cost digits and time).
float gammaToRun(float beta) {
  float gamma = keptShare(beta);
  float g = gamma;
  [[unroll]] for (int bit = findMSB(RUN) - 1; bit >= 0; --bit) {
    g *= g;
    if (((RUN >> bit) & 1) != 0) g *= gamma;
  }
  return g;
}

/// `end`: state after this lane's run, filtered from zero, or in lane 0 from `start`. Returns the state
/// before the run.
FilterState filterBeforeRun(FilterState end, FilterState start, float beta) {
  if (kLanes == 1) return start;
  float n = float(RUN);
  float gammaToN = gammaToRun(beta);
  [[unroll]] for (uint o = 1; o < kLanes; o *= 2) {
    FilterState before = FilterState(fromRootward(end.a, o), fromRootward(end.d, o));
    FilterState joined = carryFilter(before, end, n, gammaToN);
    if (lane >= o) end = joined;
    n *= 2.0;
    gammaToN *= gammaToN;
  }
  FilterState before = FilterState(fromRootward(end.a, 1), fromRootward(end.d, 1));
  return lane == 0 ? start : before;
}

/// The same from the tip: `end` is the state after this lane's run was filtered from its tip end, starting
/// from zero.
FilterState filterBeyondRun(FilterState end, float beta) {
  FilterState nothing = emptyFilter();
  if (kLanes == 1) return nothing;
  float n = float(RUN);
  float gammaToN = gammaToRun(beta);
  [[unroll]] for (uint o = 1; o < kLanes; o *= 2) {
    FilterState before = FilterState(fromTipward(end.a, o), fromTipward(end.d, o));
    FilterState joined = carryFilter(before, end, n, gammaToN);
    if (lane + o < kLanes) end = joined;
    n *= 2.0;
    gammaToN *= gammaToN;
  }
  FilterState before = FilterState(fromTipward(end.a, 1), fromTipward(end.d, 1));
  if (lane == kLanes - 1) before = nothing;
  return before;
}

#endif
