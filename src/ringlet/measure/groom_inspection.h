// GroomInspection: properties of a groom as it was read: sizes, curl, its likely unit and up axis, and its
// faults.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "ringlet/base/bounds.h"
#include "ringlet/groom/groom.h"
#include "ringlet/groom/scalp_surface.h"

namespace ringlet {

/// Extremes, median and mean of some values; all 0 without values.
struct Middle {
  double min = 0, median = 0, mean = 0, max = 0;
};
Middle middleOf(std::vector<double> values);

/// A unit that a groom may be in, and the mean length of its strands with it.
struct LikelyUnit {
  const char* name = "";
  double metresPerUnit = 0, meanLength = 0;  // [m]
};

/// Plausible range of the mean length of a head's hair [m].
inline constexpr double kShortestHair = 0.03, kLongestHair = 1;
/// An edge is reported if it is shorter than this share of its strand's mean edge.
inline constexpr double kShortEdgeShare = 1e-3;
/// Or if it is longer than its strand's median edge by this factor.
inline constexpr double kLongEdge = 6;

/// A fault of a groom: how often it occurs, and in which strands.
struct GroomFault {
  std::size_t count = 0, firstStrand = 0;
  std::vector<std::uint32_t> strands{};  // that have it, ascending

  /// Of one strand after the other.
  void add(std::size_t strand, std::size_t number = 1) {
    if (number == 0) return;
    if (count == 0) firstStrand = strand;
    if (strands.empty() || strands.back() != strand) strands.push_back(static_cast<std::uint32_t>(strand));
    count += number;
  }
};

/// Sizes and curl of a groom.
struct GroomShape {
  std::size_t strandCount = 0, particleCount = 0;
  Middle particles;               // of a strand
  Middle length;                  // of a strand, along its edges [unit]
  Middle arcOverChord;            // of strands whose root and tip are apart
  std::size_t curledCount = 0;    // by measureCurl
  Middle turns, radius;           // of the curled [1, unit]
  Bounds box;                     // around all particles [unit]
  std::vector<LikelyUnit> units;  // of metre, centimetre, millimetre and inch those that suit a head's hair
  char likelyUp = 0;              // see likelyUpOf
};

/// The shape of a groom with its faults.
struct GroomInspection : GroomShape {
  GroomFault repeatedParticles;           // at the same place as the one before
  GroomFault shortEdges;                  // not counting repeatedParticles
  GroomFault longEdges;                   // compared with the strand's median
  GroomFault strayParticles;              // far from all hair (stray_points.h)
  GroomFault thrownParticles;             // off their strand, alone (thrown_points.h)
  GroomFault sharedParticles;             // at the very place of another strand's particle
  GroomFault reversedStrands;             // from tip to root (turned_strands.h)
  GroomFault floatingRoots, sunkRoots;    // above the scalp and below it (root_heights.h)
  GroomFault pointStrands;                // all particles at one place
  GroomFault duplicates;                  // strands with the same particles as an earlier one
  GroomFault twins;                       // strands that are nearly an earlier one (twin_strands.h)
  GroomFault tooShort, tooLong, farAway;  // stray_strands.h
  GroomFault coarseCurls;                 // with fewer than four particles a turn (coarse_curls.h)

  bool isFaultless() const {
    for (const GroomFault* fault :
         {&repeatedParticles, &shortEdges, &longEdges, &strayParticles, &thrownParticles, &sharedParticles,
          &reversedStrands, &floatingRoots, &sunkRoots, &pointStrands, &duplicates, &twins, &tooShort,
          &tooLong, &farAway, &coarseCurls}) {
      if (fault->count > 0) return false;
    }
    return true;
  }
};

/// Those of metre, centimetre, millimetre and inch in which strands of this mean length [unit] would suit a
/// head.
std::vector<LikelyUnit> likelyUnits(double meanLength);

/// For a groom as readers return it (at least two particles a strand, all finite), as for the functions
/// below. The axis against which all strands together hang: 'Y' or 'Z'; 0 if they hang along neither. Cost:
/// linear.
char likelyUpOf(const Groom& groom);

/// Cost: n log n in the strands, and measureCurl of each.
GroomShape inspectShape(const Groom& groom);

/// `scalp` is what roots are on [m], if that is known; else it is what they span. Cost: that of inspectShape,
/// and n log n in the particles.
GroomInspection inspectGroom(const Groom& groom, const ScalpSurface* scalp = nullptr);

}  // namespace ringlet
