// Chebyshev acceleration of the point Jacobi iteration (Golub and Varga 1961): the weight of each iteration,
// from that of the one before. gap = 1 - mu^2, mu a bound on the iteration's spectral radius. Mirrored by
// iteratePoints in reference/strand_solve.h.
float chebyshevWeight(uint iteration, float weight, float gap) {
  return iteration == 1 ? 2.0 / (1.0 + gap) : 4.0 / ((4.0 - weight) + gap * weight);
}
