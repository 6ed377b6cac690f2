// StepClock: the number of steps of a simulation and its time. The length of a step may change.
#pragma once

#include <cstdint>

#include "ringlet/base/archive.h"

namespace ringlet {

struct StepClock {
  std::uint64_t steps = 0;        // since the simulation began
  std::uint64_t stepsBefore = 0;  // steps and seconds when the present step length began
  double secondsBefore = 0;

  /// Seconds since the simulation began, if steps now have this length.
  double seconds(double stepSeconds) const {
    return secondsBefore + static_cast<double>(steps - stepsBefore) * stepSeconds;
  }
  /// Ends steps of this length; later ones have another.
  void endLength(double stepSeconds) {
    secondsBefore = seconds(stepSeconds);
    stepsBefore = steps;
  }
  void archive(Archive& archive) {
    archive.value(steps);
    archive.value(stepsBefore);
    archive.value(secondsBefore);
  }
};

}  // namespace ringlet
