// MaterialExtremes: the extreme values of a material and a step over all strands, and the warnings about
// them.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "ringlet/rest/material.h"
#include "ringlet/rest/strand_constants.h"
#include "ringlet/scene/settings.h"

namespace ringlet {

struct MaterialExtremes {
  std::size_t cappedStrands = 0;
  double smallestCoreShare = 1;
  std::size_t unstableStrands = 0;  // strands whose bending gains energy because the step is too long
  double longestCalmStep = 1;       // [s]
  std::size_t overloadedStrands = 0;
  double largestLoad = 0;
  std::size_t largestLoadStrand = 0;

  /// `stiffest`: largest factor of its bend stiffness profile; `load`: largest load of its preload.
  void add(const StrandConstants& strand, double stiffest, double load, std::size_t groomIndex,
           const Settings& settings);

  /// Warnings for the user, a sentence each. `strandCount`: number of strands that were added.
  std::vector<std::string> warnings(std::size_t strandCount, const Material& material,
                                    const Settings& settings) const;
};

/// The longest outer step without a warning about this strand [s]. `stiffest`: as for add.
double longestCalmStepOf(const StrandConstants& strand, double stiffest);

/// Number of steps per frame such that each is at most this long [s].
int stepsOf(double longestStep, const Settings& settings);

}  // namespace ringlet
