// Guides that tests of hairs share: heads of curls, and the same roots with straight strands.
#pragma once

#include <algorithm>
#include <vector>

#include "ringlet/follow/follow_hairs.h"
#include "ringlet/groom/generate.h"

namespace ringlet::test {

using Strand = std::vector<Vec3d>;

inline std::vector<Strand> headOf(int strands, double turns = 8) {
  const Result<Groom> groom = makeHead({.curl = {.turns = turns}, .strandCount = strands});
  std::vector<Strand> all;
  for (std::size_t s = 0; s < groom->strandCount(); ++s) {
    Strand& strand = all.emplace_back();
    for (const Vec3f& p : groom->strand(s)) strand.push_back(Vec3d(p) * groom->metresPerUnit);
  }
  return all;
}

inline std::vector<GuideRest> restsOf(const std::vector<Strand>& strands) {
  std::vector<GuideRest> rests;
  for (const Strand& strand : strands) rests.push_back(restOfGuide(strand));
  return rests;
}

// From the same roots, each to where `way` leads.
template <class Way>
std::vector<Strand> straight(std::vector<Strand> strands, const Way& way) {
  for (Strand& strand : strands) {
    const Vec3d root = strand.front(), led = way(root);
    for (std::size_t i = 0; i < strand.size(); ++i)
      strand[i] = root + led * (double(i) / double(strand.size() - 1));
  }
  return strands;
}

inline double median(std::vector<double> values) {
  std::ranges::nth_element(values, values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2));
  return values[values.size() / 2];
}

}  // namespace ringlet::test
