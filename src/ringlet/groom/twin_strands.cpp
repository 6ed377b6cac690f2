// Implements groom/twin_strands.h: the mean of a strand's particles is the same from either end, so that
// twins have their means within the distance they may have.
#include "ringlet/groom/twin_strands.h"

#include <algorithm>
#include <span>

#include "ringlet/base/assert.h"
#include "ringlet/base/box_pairs.h"
#include "ringlet/base/mean.h"
#include "ringlet/groom/strand_length.h"

namespace ringlet {
namespace {

constexpr std::size_t kMostCompared = 256;  // of each strand on average

bool areTwins(std::span<const Vec3f> one, std::span<const Vec3f> other, double most) {
  if (one.size() != other.size()) return false;
  const auto isNear = [&](std::size_t i, std::size_t j) {
    return length(Vec3d(one[i]) - Vec3d(other[j])) <= most;
  };
  const std::size_t last = one.size() - 1;
  bool isSame = true, isReversed = true;
  for (std::size_t i = 0; i <= last && (isSame || isReversed); ++i) {
    isSame = isSame && isNear(i, i);
    isReversed = isReversed && isNear(i, last - i);
  }
  return isSame || isReversed;
}

}  // namespace

std::vector<bool> twinStrands(const Groom& groom, const std::vector<bool>& isLeftOut) {
  const std::size_t strands = groom.strandCount();
  RINGLET_ASSERT(isLeftOut.size() == strands, "a word for every strand");
  std::vector<Box> boxes;
  std::vector<double> reach;
  std::vector<std::size_t> strandOf;
  for (std::size_t s = 0; s < strands; ++s) {
    const double whole = lengthAlong(groom.strand(s));
    if (isLeftOut[s] || !(whole > 0)) continue;
    reach.push_back(kTwinShare * whole);
    strandOf.push_back(s);
    boxes.push_back({meanOf(groom.strand(s)), Vec3d{1, 1, 1} * reach.back()});
  }
  std::vector<bool> isTwin(strands, false);
  const BoxPairs pairs(boxes);
  std::size_t compared = 0;
  for (std::size_t i = 0; i < boxes.size() && compared <= kMostCompared * boxes.size(); ++i) {
    if (isTwin[strandOf[i]]) continue;
    pairs.visitPartners(i, [&](std::size_t j) {
      const auto [low, high] = std::minmax(strandOf[i], strandOf[j]);
      ++compared;
      if (isTwin[low] || isTwin[high]) return;
      isTwin[high] = areTwins(groom.strand(low), groom.strand(high), std::max(reach[i], reach[j]));
    });
  }
  return isTwin;
}

}  // namespace ringlet
