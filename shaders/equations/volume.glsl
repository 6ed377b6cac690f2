// Hair as a volume: a strand feels the mean velocity and the mean displacement of the hair around it, taken
// from the nodes of a grid; our own. With T the step, lambda drag, k stiffness, o the share of other strands
// in the density at a particle, W its weight at a node, all in the head's frame:
//
//   kappa = lambda T + k T^2      g = m o kappa      a = kappa w + k T s
//   A_n = sum W g a / sum W g     the particle gets the momentum  m o (sum W A_n - k T s) - g w(v)
//
// w: velocity relative to the rigidly carried head; s: displacement, which decays. At rest both are 0 and so
// is everything else. The momenta that particles give each other sum to 0 once w is the final velocity.
//
// The first iteration of a step guesses v^0 + beta (c - theta J / m) for that velocity: c is the change from
// v^0 by the last step, J the momentum that the volume gave the particle in it, beta = kVolumeWarmth, theta =
// 1 / (2 + kappa). c alone would pass an error e of the mean on from step to step: a particle whose system is
// l m receives kappa / (l + kappa) of it as a change by others, and J / m is l times that. With J it passes
// on beta kappa (1 - theta l) / (l + kappa) of e, whose size is at most beta kappa / (2 + kappa) for any l >=
// 1. In a steady state J sums to 0, and the guess lacks 1 - beta of c.
// Mirrored by reference/equations/volume.h.
#ifndef RINGLET_VOLUME
#define RINGLET_VOLUME

/// o: the share of the density that is not the strand's own.
float othersShare(float ownDensity, float density) {
  return density > 0.0 ? clamp(1.0 - ownDensity / density, 0.0, 1.0) : 0.0;
}

/// kappa [1].
float volumeGain(float drag, float stiffness, float T) { return T * (drag + T * stiffness); }

/// a [m/s]: w: [m/s]; s: [m].
vec3 volumeRate(float drag, float stiffness, float T, vec3 w, vec3 s) {
  return volumeGain(drag, stiffness, T) * w + stiffness * T * s;
}

/// The change that is guessed for v^0 [m/s]; c: [m/s]; given: J / m [m/s]; gain: kappa.
vec3 guessedChange(float warmth, float gain, vec3 c, vec3 given) { return warmth * (c - given / (2.0 + gain)); }

/// s one step later. moved: motion in the head's frame [m]; kept: exp(-T / tau).
vec3 fadedDisplacement(vec3 s, vec3 moved, float kept) { return kept * (s + moved); }

/// W at a node `apart` cells away: trilinear.
float nodeWeight(vec3 apart) {
  vec3 w = max(1.0 - abs(apart), vec3(0));
  return w.x * w.y * w.z;
}

#endif
