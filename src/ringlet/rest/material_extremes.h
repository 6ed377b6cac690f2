// MaterialExtremes: the worst that a material and a step do to any strand, and the warnings of it.
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
  std::size_t feedingStrands = 0;  // the step is too long for their bending
  double longestCalmStep = 1;      // [s]
  std::size_t overloadedStrands = 0;
  double largestLoad = 0;
  std::size_t largestLoadStrand = 0;

  /// `stiffest`: the largest factor of its bend stiffness profile; `load`: the largest of its preload.
  void add(const StrandConstants& strand, double stiffest, double load, std::size_t groomIndex,
           const Settings& settings);

  /// For the user, a sentence each. `strandCount`: those that were added.
  std::vector<std::string> warnings(std::size_t strandCount, const Material& material,
                                    const Settings& settings) const;
};

/// The longest outer step that needs no warning of this strand, whose bend stiffness profile is at most
/// `stiffest` [s].
double longestCalmStepOf(const StrandConstants& strand, double stiffest);

/// Steps a frame that are no longer than this [s].
int stepsOf(double longestStep, const Settings& settings);

}  // namespace ringlet
