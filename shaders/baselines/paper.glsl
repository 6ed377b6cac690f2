// `paper`: Iben et al. 2012, section 5, with its explicit loops and its springs as printed: forces n_f times
// a step, damping n_d times a force loop, each followed by the velocity limit of section 3.1. Stable while 4
// c_max T / (n_f n_d m) stays below about 1.1. Included by kernels/strand_step.comp.
#ifndef RINGLET_PAPER
#define RINGLET_PAPER

#include "equations/frame.glsl"
#include "equations/stretch_limit.glsl"
#include "scan/filter_scan.glsl"
#include "scan/prefix_sum.glsl"
#include "shared/strand_run.glsl"

vec3 coreDirection[RUN];  // of the core's smoothed edges

// Rate of edge k, with the velocity of the next lane's first particle.
vec3 rateOfEdge(int k, vec3 vNext) { return (k + 1 < RUN ? v[min(k + 1, RUN - 1)] : vNext) - v[k]; }

// Computes the core's smoothed edges again, since the damping loops need their directions. Smoothed from the
// first edge, as printed.
void findCoreDirections() {
  FilterState rootState = startFilter(e[0], strand.coreBeta);
  FilterState state = rootState;
  if (kLanes > 1) {
    if (lane > 0) state = emptyFilter();
    RINGLET_OVER_RUN for (int k = 0; k < runEnd; ++k) smoothNext(state, e[k], strand.coreBeta);
    state = filterBeforeRun(state, rootState, strand.coreBeta);
  }
  RINGLET_OVER_RUN for (int k = 0; k < runEnd; ++k) {
    smoothNext(state, e[k], strand.coreBeta);
    coreDirection[k] = directionOf(smoothed(state, strand.coreBeta));
  }
}

// Damping of edge k; `rate`: velocity difference of its ends, `coreRate`: that of the smoothed edge.
vec3 dampingOfEdge(int k, vec3 rate, vec3 coreRate) {
  vec3 stretching = dot(rate, eHat[k]) * eHat[k];
  return restEdge[k].w * (strand.stretchDamping * stretching + strand.bendDamping * (rate - stretching) +
                          coreScale * strand.coreDamping * dot(coreRate, coreDirection[k]) * coreDirection[k]);
}

void dampOnce(float dt) {
  vec3 vNext = fromTipward(v[0], 1);
  FilterState rootState = startFilter(rateOfEdge(0, vNext), strand.coreBeta);
  FilterState state = rootState;
  if (kLanes > 1) {
    if (lane > 0) state = emptyFilter();
    RINGLET_OVER_RUN for (int k = 0; k < runEnd; ++k) smoothNext(state, rateOfEdge(k, vNext), strand.coreBeta);
    state = filterBeforeRun(state, rootState, strand.coreBeta);
  }
  // Particle 0 needs the force that the lane before finds for the edge to it.
  vec3 ofFirst = vec3(0);
  vec3 damping = vec3(0);
  RINGLET_OVER_RUN for (int k = 0; k < runEnd; ++k) {
    vec3 rate = rateOfEdge(k, vNext);
    vec3 before = damping;
    smoothNext(state, rate, strand.coreBeta);
    damping = dampingOfEdge(k, rate, smoothed(state, strand.coreBeta));
    if (k == 0) ofFirst = damping;
    if (k > 0 && isFree(k)) v[k] += dt / restEdge[k].x * (damping - before);
  }
  vec3 before = fromRootward(damping, 1);
  if (lane == 0) before = vec3(0);
  if (isFree(0)) v[0] += dt / restEdge[0].x * (ofFirst - before);
}

void limitRates() {
  vec3 vNext = fromTipward(v[0], 1);
  vec3 changeInRun[RUN];  // of particle k, by the edges of this lane
  vec3 change = vec3(0);
  RINGLET_OVER_RUN for (int k = 0; k < runEnd; ++k) {
    float fastest = max(0.0, (restEdge[k].y - eLength[k]) / stepSeconds());
    changeInRun[k] = change;
    change += isPinned(k + 1) ? vec3(0) : limitedRateChange(rateOfEdge(k, vNext), eHat[k], fastest);
  }
  vec3 before = sumBeforeRun(change);
  RINGLET_OVER_RUN for (int k = 0; k < runEnd; ++k) {
    if (isFree(k)) v[k] += before + changeInRun[k];
  }
}

void loopAsThePaper(vec3 pinned[3]) {
  findCoreDirections();
  [[unroll]] for (int k = 0; k < 3; ++k) {
    if (isPinned(k)) v[k] = pinned[k];
  }
  vec3 forceBefore = forceFromRootward();
  float dtForce = stepSeconds() / float(numbers.forceLoops);
  float dtDamping = dtForce / float(numbers.dampingLoops);
  uint loop = 0;
  do {
    RINGLET_OVER_RUN for (int k = 0; k < runEnd; ++k) {
      vec3 pull = force[k] - (k > 0 ? force[max(k - 1, 0)] : forceBefore);
      if (isFree(k)) v[k] += dtForce * (pull / restEdge[k].x + pullOnRun(k));
    }
    uint inner = 0;
    do {
      dampOnce(dtDamping);
      limitRates();
    } while (++inner < numbers.dampingLoops);
  } while (++loop < numbers.forceLoops);
}

#endif
