// Implements groom/stray_strands.h.
#include "ringlet/groom/stray_strands.h"

#include <algorithm>
#include <cstddef>
#include <span>

#include "ringlet/base/mean.h"
#include "ringlet/base/median.h"
#include "ringlet/groom/strand_length.h"

namespace ringlet {
namespace {

constexpr std::size_t kLeastForNine = 10;  // strands, of which nine tell of one

// As long as nine of ten strands are at most; 0 of few.
double lengthOfNine(std::vector<double> lengths) {
  if (lengths.size() < kLeastForNine) return 0;
  const auto last = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() * 9 / 10 - 1);
  std::ranges::nth_element(lengths, last);
  return *last;
}

// Of each strand's middle from the median of all.
std::vector<double> distancesFromMiddle(const Groom& groom) {
  std::vector<Vec3d> centres;
  std::vector<double> x, y, z, distances;
  for (std::size_t s = 0; s < groom.strandCount(); ++s) {
    centres.push_back(meanOf(groom.strand(s)));
    x.push_back(centres.back().x);
    y.push_back(centres.back().y);
    z.push_back(centres.back().z);
  }
  const Vec3d middle{medianOf(std::move(x)), medianOf(std::move(y)), medianOf(std::move(z))};
  for (const Vec3d& centre : centres) distances.push_back(length(centre - middle));
  return distances;
}

}  // namespace

StrayStrands strayStrands(const Groom& groom) {
  std::vector<double> lengths;
  for (std::size_t s = 0; s < groom.strandCount(); ++s) lengths.push_back(lengthAlong(groom.strand(s)));
  const std::vector<double> distances = distancesFromMiddle(groom);
  const double median = medianOf(lengths), nine = lengthOfNine(lengths);
  // In a groom of one strand, or with all strands in a row, distances up to the median length count as near.
  const double near = std::max(medianOf(distances), median);
  StrayStrands found;
  for (std::size_t s = 0; s < lengths.size(); ++s) {
    found.isTooShort.push_back(lengths[s] > 0 && lengths[s] * kStrayLength < median);
    found.isTooLong.push_back((median > 0 && lengths[s] > kStrayLength * median) ||
                              (nine > 0 && lengths[s] > kStrayOfNine * nine));
    found.isFarAway.push_back(distances[s] > kStrayDistance * near);
  }
  return found;
}

}  // namespace ringlet
