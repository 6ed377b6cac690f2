// No hair through hair: after a step's move the ways of particles are changed until no edge of one strand can
// pass through an edge of another. Ours; ties after Bridson et al. 2002. On the host, in double: what is
// known not to cross is known of the numbers that are stored.
//
//     listing   crossing_pairs.h; again as soon as a particle is further than kCrossingReach from where it
//     was pushing   each pair that may cross, or ends nearer than it aims to, pushes its four ends apart;
//     what a
//               strand is pushed by spreads along it, less far from pass to pass:
//
//                   G = (M + k L)^-1     M masses, L the chain's Laplacian, k = (spread edges)^2 mean mass
//                   p_i = +- sum_k b_ki l_k n_k,   x += G p
//                   l_k = relax d_k / sum_i b_ki (G sum_k b_k)_i
//
//               d_k [m] is what pair k lacks, b_ki are its ends' shares. The divisor is no less than a row
//               sum of the system of all l, so that Jacobi converges for any number of pairs; both sides of a
//               pair get the same, so that momentum stays. Without the spread edges are stretched.
//     tying     what may still cross after some more local pushes is tied (crossing_ties.h), and the same
//     over
//               again with what this makes cross; at last without pushes
//
// It ends when all pairs of a list that holds are known not to cross, at places as they are stored. If it
// does not, all free hair moves as the head does, which is reported. Jacobi: nothing depends on an order.
#pragma once

#include <vector>

#include "ringlet/base/vec3.h"
#include "ringlet/crossings/crossing_pairs.h"
#include "ringlet/crossings/crossing_report.h"

namespace ringlet {

/// How hard the stage tries, and how places are stored. Tests change it.
struct CrossingEffort {
  int pushPasses = 20;
  int turnsBetweenTies = 7;  // local pushes before what may still cross is tied
  int tieRounds = 8;
  bool storesFloat = true;  // places are stored as floats
};

/// turn: the head's in the step. from, to: all particles at the step's start and end [m]; `to` is changed.
/// The result does not depend on the number of threads. Cost: some 10 us an edge of dense hair.
CrossingReport keepFromCrossing(const CrossingHair& hair, const Quatd& turn, const std::vector<Vec3d>& from,
                                std::vector<Vec3d>& to, const CrossingEffort& effort = {});

}  // namespace ringlet
