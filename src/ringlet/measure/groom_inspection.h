// GroomInspection: properties of a groom as it was read: sizes, curl, its likely unit and up axis, and its
// faults.
#pragma once

#include <cstddef>
#include <vector>

#include "ringlet/base/bounds.h"
#include "ringlet/groom/groom.h"

namespace ringlet {

/// Extremes and the middle of some values; all 0 without any.
struct Middle {
  double min = 0, median = 0, mean = 0, max = 0;
};
Middle middleOf(std::vector<double> values);

/// A unit a groom may be in, and how long its strands would be on average.
struct LikelyUnit {
  const char* name = "";
  double metresPerUnit = 0, meanLength = 0;  // [m]
};

/// A head's hair is this long on average [m].
inline constexpr double kShortestHair = 0.03, kLongestHair = 1;
/// A strand shorter or longer than the median by this factor is a stray, and so is one that is this many
/// times the median distance away from the middle of all.
inline constexpr double kStrayLength = 20, kStrayDistance = 6;
/// An edge shorter than this share of its strand's mean edge is mentioned.
inline constexpr double kShortEdgeShare = 1e-3;
/// And one that is longer than its strand's median by this factor.
inline constexpr double kLongEdge = 6;

/// What is wrong with a groom: how much of it, and one strand as an example.
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
  Middle arcOverChord;            // of strands whose ends are apart
  std::size_t curledCount = 0;    // by measureCurl
  Middle turns, radius;           // of the curled [1, unit]
  Bounds box;                     // around all particles [unit]
  std::vector<LikelyUnit> units;  // metre, centimetre, millimetre, inch: those that fit a head's hair
  char likelyUp = 0;              // likelyUpOf
};

/// And its faults.
struct GroomInspection : GroomShape {
  GroomFault repeatedParticles;           // in the place of the one before
  GroomFault shortEdges;                  // those above not counted
  GroomFault longEdges;                   // than the strand's median
  GroomFault strayParticles;              // far off where no hair is (stray_points.h)
  GroomFault sharedParticles;             // others in the very place of another strand's
  GroomFault reversedStrands;             // that end on the head and begin away from it (root_ends.h)
  GroomFault pointStrands;                // all in one place
  GroomFault duplicates;                  // strands of the very particles of one before
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

/// Metre, centimetre, millimetre, inch: those in which strands of this mean length [unit] would fit a head.
std::vector<LikelyUnit> likelyUnits(double meanLength);

/// Of a groom as readers return it (two finite particles and more a strand), as all below. The axis against
/// which the strands hang, all together: 'Y' or 'Z', 0 where they hang along neither. Cost: linear.
char likelyUpOf(const Groom& groom);

/// Cost: n log n in the strands, and measureCurl of each.
GroomShape inspectShape(const Groom& groom);

/// Cost: that of inspectShape, and n log n in the particles.
GroomInspection inspectGroom(const Groom& groom);

}  // namespace ringlet
