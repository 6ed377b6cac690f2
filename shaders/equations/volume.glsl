// Hair as a volume: a strand feels the mean velocity and the mean displacement of the hair about it, those of a grid's
// nodes; ours. With T the step, lambda drag, k stiffness, o the share that others have in the density about a
// particle, W its weight at a node, all in the head's frame:
//
//   kappa = lambda T + k T^2      g = m o kappa      a = kappa w + k T s, each component cut to `most`
//   A_n = sum W g a / sum W g     the particle gets the momentum  m o (sum W A_n - k T s) - g w(v)
//
// w: velocity beside the rigidly carried head; s: displacement, which fades. At rest both are 0 and so is all else.
// What particles give each other sums to 0 once w is the velocity they end with. Mirrored by
// reference/equations/volume.h.
#ifndef RINGLET_VOLUME
#define RINGLET_VOLUME

/// o: what is not its own strand's.
float othersShare(float ownDensity, float density) {
  return density > 0.0 ? clamp(1.0 - ownDensity / density, 0.0, 1.0) : 0.0;
}

/// kappa [1].
float volumeGain(float drag, float stiffness, float T) { return T * (drag + T * stiffness); }

/// a [m/s]: w: [m/s]; s: [m]; most: [m/s].
vec3 volumeRate(float drag, float stiffness, float T, vec3 w, vec3 s, float most) {
  return clamp(volumeGain(drag, stiffness, T) * w + stiffness * T * s, -most, most);
}

/// s a step later: moved: by how much in the head's frame [m]; kept: exp(-T / tau).
vec3 fadedDisplacement(vec3 s, vec3 moved, float kept) { return kept * (s + moved); }

/// W at a node `apart` cells away: trilinear.
float nodeWeight(vec3 apart) {
  vec3 w = max(1.0 - abs(apart), vec3(0));
  return w.x * w.y * w.z;
}

#endif
