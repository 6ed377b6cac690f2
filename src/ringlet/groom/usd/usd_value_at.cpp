// Implements groom/usd/usd_value_at.h.
#include "ringlet/groom/usd/usd_value_at.h"

#include <algorithm>

namespace ringlet {

UsdValue usdValueAt(const std::vector<UsdSample>& samples, double time) {
  const auto after = std::ranges::upper_bound(samples, time, {}, &UsdSample::time);
  if (after == samples.begin()) return samples.front().value;
  const UsdSample& a = *(after - 1);
  if (after == samples.end() || a.value.numbers.size() != after->value.numbers.size()) return a.value;
  UsdValue value = a.value;
  const double share = (time - a.time) / (after->time - a.time);
  double alike = 0;
  for (std::size_t k = 0; k < value.numbers.size(); ++k) alike += value.numbers[k] * after->value.numbers[k];
  const double sign = value.numbers.size() == 4 && alike < 0 ? -1 : 1;
  for (std::size_t k = 0; k < value.numbers.size(); ++k)
    value.numbers[k] += (sign * after->value.numbers[k] - value.numbers[k]) * share;
  return value;
}

}  // namespace ringlet
