// StepClock: the steps that a simulation has done, and its time, while the length of a step may change.
#pragma once

#include <cstdint>

#include "ringlet/base/archive.h"

namespace ringlet {

struct StepClock {
  std::uint64_t steps = 0;        // since the simulation began
  std::uint64_t stepsBefore = 0;  // steps and seconds before the present step length
  double secondsBefore = 0;

  /// Since the simulation began, with steps of this length now.
  double seconds(double stepSeconds) const {
    return secondsBefore + static_cast<double>(steps - stepsBefore) * stepSeconds;
  }
  /// Steps of this length end now.
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
