// medianOf: the middle of some numbers, which a few wild ones among them do not move.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace ringlet {

/// Of two in the middle the upper; 0 without values. Cost: linear.
inline double medianOf(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Median distance from `middle`, times 1.4826: the standard deviation where values are spread normally.
inline double spreadAbout(double middle, std::vector<double> values) {
  for (double& value : values) value = std::abs(value - middle);
  return 1.4826 * medianOf(std::move(values));
}

}  // namespace ringlet
