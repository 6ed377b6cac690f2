// `paper`: Iben et al. 2012, section 5, its explicit loops and its springs as printed: forces n_f times a step, damping
// n_d times a force loop, each followed by the velocity limit of section 3.1. Stable while 4 c_max T / (n_f n_d m)
// stays below about 1.1. Included by kernels/strand_step.comp.

// The core's smoothed edges again: the damping loops need their directions. Smoothed from the first edge, as printed.
void smoothedEdges(vec3 x[RUN], vec3 start, out vec3 result[RUN]) {
  FilterState state = startFilter(start, strand.coreBeta);
  FilterState rootState = state;
  if (lane > 0) state = emptyFilter();
  if (kLanes > 1) {
    [[unroll]] for (int k = 0; k < RUN; ++k) smoothNext(state, x[k], strand.coreBeta);
  }
  state = filterBeforeRun(state, rootState, strand.coreBeta);
  [[unroll]] for (int k = 0; k < RUN; ++k) {
    smoothNext(state, x[k], strand.coreBeta);
    result[k] = smoothed(state, strand.coreBeta);
  }
}

void differencesOfVelocity() {
  vec3 vNext = fromTipward(v[0], 1);
  [[unroll]] for (int k = 0; k < RUN; ++k) {
    dv[k] = (k + 1 < RUN ? v[min(k + 1, RUN - 1)] : vNext) - v[k];
  }
}

void dampOnce(float dt, vec3 coreDirection[RUN]) {
  differencesOfVelocity();
  vec3 nu[RUN];
  smoothedEdges(dv, dv[0], nu);
  vec3 damping[RUN];
  [[unroll]] for (int k = 0; k < RUN; ++k) {
    vec3 stretching = dot(dv[k], eHat[k]) * eHat[k];
    damping[k] = restEdge[k].w * (strand.stretchDamping * stretching + strand.bendDamping * (dv[k] - stretching) +
                                  coreScale * strand.coreDamping * dot(nu[k], coreDirection[k]) * coreDirection[k]);
  }
  vec3 before = fromRootward(damping[RUN - 1], 1);
  if (lane == 0) before = vec3(0);
  [[unroll]] for (int k = 0; k < RUN; ++k) {
    if (isFree(k)) v[k] += dt / restEdge[k].x * (damping[k] - (k > 0 ? damping[max(k - 1, 0)] : before));
  }
}

void limitRates() {
  differencesOfVelocity();
  vec3 shift = vec3(0);
  [[unroll]] for (int k = 0; k < RUN; ++k) {
    float fastest = max(0.0, (restEdge[k].y - eLength[k]) / stepSeconds());
    vec3 change = isPinned(k + 1) ? vec3(0) : limitedRateChange(dv[k], eHat[k], fastest);
    dv[k] = shift;  // of particle k
    shift += change;
  }
  vec3 before = sumBeforeRun(shift);
  [[unroll]] for (int k = 0; k < RUN; ++k) {
    if (isFree(k)) v[k] += before + dv[k];
  }
}

void loopAsThePaper(vec3 pinned[3]) {
  vec3 coreDirection[RUN];
  smoothedEdges(e, e[0], coreDirection);
  [[unroll]] for (int k = 0; k < RUN; ++k) {
    coreDirection[k] = directionOf(coreDirection[k]);
    if (isPinned(k)) v[k] = pinned[min(k, 2)];
  }
  vec3 forceBefore = forceFromRootward();
  float dtForce = stepSeconds() / float(parameters.forceLoops);
  float dtDamping = dtForce / float(parameters.dampingLoops);
  for (uint loop = 0; loop < parameters.forceLoops; ++loop) {
    [[unroll]] for (int k = 0; k < RUN; ++k) {
      vec3 pull = force[k] - (k > 0 ? force[max(k - 1, 0)] : forceBefore);
      if (isFree(k)) v[k] += dtForce * (pull / restEdge[k].x + pullOnRun(k));
    }
    for (uint inner = 0; inner < parameters.dampingLoops; ++inner) {
      dampOnce(dtDamping, coreDirection);
      limitRates();
    }
  }
}
