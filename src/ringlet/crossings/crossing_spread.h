// Spreads what particles are pushed by along their strands.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "ringlet/crossings/crossing_pairs.h"

namespace ringlet {

/// values <- G values, G = (M + k L)^-1 of each strand (crossing_step.h), by elimination; 0 where the way is
/// given. share: how far they spread, of a strand's edges; 0: G = M^-1.
template <class Value>
void spreadAlong(const CrossingHair& hair, double share, std::vector<Value>& values) {
  std::vector<double> factors(values.size());
  for (std::size_t s = 0; s + 1 < hair.firstPoint.size(); ++s) {
    const std::size_t begin = hair.firstPoint[s], end = hair.firstPoint[s + 1];
    double mass = 0;
    for (std::size_t i = begin; i < end; ++i) mass += hair.masses[i] / static_cast<double>(end - begin);
    const double edges = share * static_cast<double>(end - begin - 1), k = edges * edges * mass;
    for (std::size_t i = begin; i < end; ++i) {
      const double m = hair.masses[i], before = i > begin ? k : 0, next = i + 1 < end ? k : 0;
      if (i > begin) values[i] += before * values[i - 1];
      const double diagonal = m + next + before * (1 - (i > begin ? factors[i - 1] : 0));
      factors[i] = m > 0 ? next / diagonal : 0;
      values[i] = (m > 0 ? 1 / diagonal : 0.0) * values[i];
    }
    for (std::size_t i = end; i-- > begin + 1;) values[i - 1] += factors[i - 1] * values[i];
  }
}

}  // namespace ringlet
