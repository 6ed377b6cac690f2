// mendGroom: a groom without what trips a simulation, and with as many particles a strand as one wants.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "ringlet/groom/groom.h"

namespace ringlet {

/// An edge shorter than this share of its strand counts as none: its two particles are in one place. Files
/// hold 6e-6 beside 4e-2, and float32 has seven digits.
inline constexpr double kNoEdgeShare = 1e-6;

/// Up to this length an edge of the strand counts as none. The strand is taken to have edges as long as its
/// upperEdge() (stray_points.h), so that a particle at 1e10 does not make all others none.
double noEdgeLength(std::span<const Vec3f> strand);

struct MendedGroom {
  Groom groom;
  std::size_t repeatedCount = 0;     // particles in the place of the one before them, taken out
  std::size_t pointStrandCount = 0;  // strands all in one place, dropped
  std::size_t duplicateCount = 0;    // strands of the very particles of one before, dropped
  std::size_t strayCount = 0;        // particles far off where no hair is, taken out (stray_points.h)
};

/// Takes out strays, merges, drops, until there is nothing more to mend, and, with a `particleCount` of 2 or
/// more, lays that many particles along each strand, at equal distances along its edges, the first and the
/// last where they were. Four a turn keep a curl. May leave no strand at all. Cost: n log n in the particles.
MendedGroom mendGroom(const Groom& groom, std::size_t particleCount = 0);

/// For each strand whether one before it has the very same particles. Cost: n log n in the particles.
std::vector<bool> duplicatesIn(const Groom& groom);

}  // namespace ringlet
