// GroomInspection: properties of a groom as it was read: sizes, curl, its likely unit and up axis, and its
// faults.
#pragma once

#include <cstddef>
#include <vector>

#include "ringlet/base/bounds.h"
#include "ringlet/groom/groom.h"

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
/// A strand is a stray if it is shorter or longer than the median by this factor, or if its distance from the
/// median place is this many times the median distance.
inline constexpr double kStrayLength = 20, kStrayDistance = 6;
/// An edge is reported if it is shorter than this share of its strand's mean edge.
inline constexpr double kShortEdgeShare = 1e-3;
/// Or if it is longer than its strand's median edge by this factor.
inline constexpr double kLongEdge = 6;

/// A fault of a groom: how often it occurs, and one strand as an example.
struct GroomFault {
  std::size_t count = 0, firstStrand = 0;

  void add(std::size_t strand, std::size_t number = 1) {
    if (count == 0 && number > 0) firstStrand = strand;
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
  GroomFault sharedParticles;             // at the very place of another strand's particle
  GroomFault reversedStrands;             // tip on the head and root away from it (root_ends.h)
  GroomFault pointStrands;                // all particles at one place
  GroomFault duplicates;                  // strands with the same particles as an earlier one
  GroomFault tooShort, tooLong, farAway;  // strays

  bool isFaultless() const {
    for (const GroomFault* fault :
         {&repeatedParticles, &shortEdges, &longEdges, &strayParticles, &sharedParticles, &reversedStrands,
          &pointStrands, &duplicates, &tooShort, &tooLong, &farAway}) {
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

/// Cost: that of inspectShape, and n log n in the particles.
GroomInspection inspectGroom(const Groom& groom);

}  // namespace ringlet
