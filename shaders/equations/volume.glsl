// Hair as a volume: a strand feels the mean velocity and the mean displacement of the hair around it, taken
// from the nodes of a grid; our own. With T the step, lambda drag, k stiffness, o the share of other strands
// in the density at a particle, W its weight at a node, all in the head's frame:
//
//   kappa = lambda T + k T^2      g = m o kappa      a = kappa w + k T s
//   A_n = sum W g (a + C (x_n - x)) / sum W g
//   A = sum W A_n,  G = sum A_n (grad W)^T
//   the particle gets the momentum  m o (A - k T s) - g w(v)
//   and keeps  C = beta_C (F - min(tr F, 0) / 3 I),  F = G diag(f),  for the next iteration
//
// w: velocity relative to the rigidly carried head; s: displacement, which decays. At rest both are 0, and so
// are C and all else. The momenta that particles give each other sum to 0 once w is the final velocity.
//
// C is an affine transfer (Jiang et al., "The Affine Particle-In-Cell Method", 2015). Without it a particle is
// drawn to its cell's mean, and a lock can neither turn nor shear within a cell. It adds nothing to any sum:
// sum W (x_n - x) = 0. Contacts resist what comes nearer, so C has no compression, and beta_C =
// kVolumeGradient: with 1 hair that is thrown across the head is pressed flat. G jumps where a particle passes a
// face of its cell; f goes to 0 there along the face's normal, from 1 at kVolumeRim of a cell, so that C is
// continuous and no rounding shows.
//
// The first iteration of a step guesses v^0 + beta (c - theta J / m) for that velocity: c is the change from
// v^0 by the last step, J the momentum that the volume gave the particle in it, theta = 1 / (2 + kappa). c
// alone would pass an error e of the mean on from step to step: a particle whose system is l m receives kappa
// / (l + kappa) of it as a change by others, and J / m is l times that. With J it passes on beta kappa (1 -
// theta l) / (l + kappa) of e, whose size is at most beta kappa / (2 + kappa) for any l >= 1.
//
// In a steady state J sums to 0 and the guess lacks 1 - beta of c. So what all hair of a neighbourhood does
// meets a resistance of kappa / (1 + kappa (1 - beta)) in a step. beta is chosen so that this is R T, R =
// kVolumeResponse, whatever the step: with one beta for all steps hair is the stiffer the more of them there
// are. R is fitted to how hair moves with explicit contacts (tests/scenes/dense_motion_test.cpp).
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

/// W along each axis, at a node `apart` cells away: trilinear.
vec3 nodeWeights(vec3 apart) { return max(1.0 - abs(apart), vec3(0)); }
float nodeWeight(vec3 apart) {
  vec3 w = nodeWeights(apart);
  return w.x * w.y * w.z;
}
/// C from the gradient of A [1/s]; inCell: place in the cell [cells], 0 to 1; rim: kVolumeRim; kept: beta_C.
mat3 keptGradient(mat3 gradient, vec3 inCell, float rim, float kept) {
  vec3 f = clamp(min(inCell, 1.0 - inCell) / rim, 0.0, 1.0);
  mat3 inner = mat3(f.x * gradient[0], f.y * gradient[1], f.z * gradient[2]);
  float compression = min(inner[0][0] + inner[1][1] + inner[2][2], 0.0) / 3.0;
  return kept * (inner - mat3(compression));
}

/// grad W [1/cell]; upper: 1 along an axis where the node is the upper one of its cell, else 0.
vec3 nodeGradient(vec3 apart, vec3 upper) {
  vec3 w = nodeWeights(apart);
  return (2.0 * upper - 1.0) * w.yxx * w.zzy;
}

#endif
