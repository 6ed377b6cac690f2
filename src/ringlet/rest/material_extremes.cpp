// Implements rest/material_extremes.h.
#include "ringlet/rest/material_extremes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ringlet/rest/material_dials.h"

namespace ringlet {
namespace {

double longestBendStep(const StrandConstants& strand, double stiffest) {
  return strand.longestBendStep / std::sqrt(stiffest);
}

}  // namespace

void MaterialExtremes::add(const StrandConstants& strand, double stiffest, double load,
                           std::size_t groomIndex, const Settings& settings) {
  if (strand.coreStiffness < strand.coreStiffnessAsked) {
    ++cappedStrands;
    smallestCoreShare = std::min(smallestCoreShare, strand.coreStiffness / strand.coreStiffnessAsked);
  }
  if (settings.stepSeconds() > longestBendStep(strand, stiffest)) ++unstableStrands;
  longestCalmStep = std::min(longestCalmStep, longestCalmStepOf(strand, stiffest));
  if (load > 0.5) ++overloadedStrands;
  if (load > largestLoad) largestLoad = load, largestLoadStrand = groomIndex;
}

std::vector<std::string> MaterialExtremes::warnings(std::size_t strandCount, const Material& material,
                                                    const Settings& settings) const {
  std::vector<std::string> sentences;
  const int needed = stepsOf(longestCalmStep, settings);
  if (cappedStrands > 0) {
    sentences.push_back(fmt::format(
        "the core spring of {} of {} strands is weakened (to {:.0f} % at least) to stay stable at {} steps "
        "per frame; {} steps per frame give it in full",
        cappedStrands, strandCount, 100 * smallestCoreShare, settings.stepsPerFrame, needed));
  }
  if (unstableStrands > 0) {
    sentences.push_back(fmt::format(
        "{} steps per frame are too few for the bending of {} of {} strands, which may not come to rest; {} "
        "steps per frame are enough, or a softer or more smoothed material",
        settings.stepsPerFrame, unstableStrands, strandCount, needed));
  }
  const double leastRatio = material.bendDampingRatio * material.bendDampingRatioProfile.least();
  if (settings.integrator != Integrator::paper && leastRatio < kLeastBendDampingRatio) {
    sentences.push_back(fmt::format("a bend damping ratio of {} may not come to rest; {} and more does",
                                    leastRatio, kLeastBendDampingRatio));
  }
  if (overloadedStrands > 0) {
    sentences.push_back(fmt::format(
        "gravity preload bends the stored shape of {} of {} strands by more than 27 degrees (strand {} most: "
        "load {:.2f}); use a stiffer material or less preload",
        overloadedStrands, strandCount, largestLoadStrand, largestLoad));
  }
  return sentences;
}

double longestCalmStepOf(const StrandConstants& strand, double stiffest) {
  return std::min(strand.longestCoreStep, longestBendStep(strand, stiffest));
}

int stepsOf(double longestStep, const Settings& settings) {
  const double steps = std::ceil(1 / (std::max(settings.framesPerSecond, 1e-3) * longestStep) - 1e-6);
  return static_cast<int>(std::min(steps, 1e9));
}

}  // namespace ringlet
