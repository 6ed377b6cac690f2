// UsdTrack: numbers of a USD attribute over time, as many at every sample.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/motion/usd_prims.h"

namespace ringlet {

/// What an attribute must hold at every sample.
struct UsdTrackForm {
  std::size_t elementCount = 0;
  std::size_t width = 1;  // numbers of an element
  std::string reason{};   // of the count: "one for each joint"
};

class UsdTrack {
 public:
  /// Errors, which name the time: another count than expected, numbers that are not finite, times that do not
  /// rise; a value that a connection gives.
  static Result<UsdTrack> of(const UsdPrims& prims, const UsdProperty& property, const UsdTrackForm& form);

  const std::vector<double>& seconds() const { return seconds_; }
  /// Sample by sample.
  std::vector<double>& numbers() { return numbers_; }

  /// Numbers of the sample at or before a time and of the one after it, and the share of the way between.
  struct Place {
    const double* before = nullptr;
    const double* after = nullptr;
    double share = 0;

    double operator[](std::size_t k) const { return before[k] + (after[k] - before[k]) * share; }
  };
  /// Before the first sample the first holds, after the last the last.
  Place at(double seconds) const;

 private:
  std::size_t width_ = 0;  // of a sample
  std::vector<double> seconds_{}, numbers_{};
};

}  // namespace ringlet
