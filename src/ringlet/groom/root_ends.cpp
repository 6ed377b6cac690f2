// Implements groom/root_ends.h.
#include "ringlet/groom/root_ends.h"

#include <algorithm>
#include <cmath>

#include "ringlet/base/assert.h"

namespace ringlet {
namespace {

constexpr std::size_t kLeastStrands = 8;  // of fewer a ball goes through nearly any ends
constexpr std::size_t kLeastForOutliers = 20;
constexpr double kLeastOn = 0.8;      // share of strands with an end where roots stand
constexpr double kCounted = 0.7;      // of the ends, the nearest; others may be of strands turned round
constexpr int kFits = 8;              // each without the farthest of the one before
constexpr double kMostUneven = 0.06;  // of ends from a head's ball, rms over its radius
constexpr double kNearRms = 3, kNear = 0.03;  // of the ball: so many rms, and this share of its radius
// Hair spreads out from a head: where its first and its last ends are on balls, the head is the smaller. Not
// one smaller than this share of the other, a knot into which hair is gathered, nor one that is less even.
constexpr double kLeastOfOther = 0.4, kAsEven = 0.01;

struct HeadOfEnds {
  Ball ball;
  bool isFound = false;
};

// Through most of them, if these lie on a ball.
HeadOfEnds headOf(const std::vector<Vec3d>& ends) {
  HeadOfEnds head;
  if (ends.size() < kLeastStrands) return head;
  std::vector<Vec3d> counted = ends;
  head.ball = ballThrough(counted);
  if (ends.size() >= kLeastForOutliers) {
    const auto keep = static_cast<std::ptrdiff_t>(kCounted * static_cast<double>(ends.size()));
    std::vector<Vec3d> order = ends;
    for (int fit = 0; fit < kFits && head.ball.radius > 0; ++fit) {
      std::ranges::nth_element(order, order.begin() + keep, {},
                               [&](Vec3d p) { return head.ball.distanceTo(p); });
      counted.assign(order.begin(), order.begin() + keep);
      head.ball = ballThrough(counted);
    }
  }
  head.isFound = isHead(head.ball, counted, kMostUneven);
  return head;
}

}  // namespace

std::vector<bool> reversedBy(std::span<const EndDistances> strands, double on, double clear) {
  std::vector<bool> isReversed(strands.size(), false);
  const auto touching = std::ranges::count_if(
      strands, [&](const EndDistances& ends) { return std::min(ends.first, ends.last) <= on; });
  if (static_cast<double>(touching) < kLeastOn * static_cast<double>(strands.size())) return isReversed;
  for (std::size_t s = 0; s < strands.size(); ++s)
    isReversed[s] = strands[s].last <= on && strands[s].first > strands[s].last + clear;
  return isReversed;
}

RootEnds findRootEnds(const Groom& groom) {
  RootEnds found;
  found.isReversed.assign(groom.strandCount(), false);
  std::vector<Vec3d> firsts, lasts;
  for (std::size_t s = 0; s < groom.strandCount(); ++s) {
    firsts.emplace_back(groom.strand(s).front());
    lasts.emplace_back(groom.strand(s).back());
  }
  const HeadOfEnds byFirsts = headOf(firsts), byLasts = headOf(lasts);
  if (!byFirsts.isFound && !byLasts.isFound) return found;
  bool isOfLasts = !byFirsts.isFound;
  if (byFirsts.isFound && byLasts.isFound) {
    const Ball &first = byFirsts.ball, &last = byLasts.ball;
    isOfLasts = last.radius < first.radius && last.radius > kLeastOfOther * first.radius &&
                last.rms / last.radius < first.rms / first.radius + kAsEven;
  }
  found.head = isOfLasts ? byLasts.ball : byFirsts.ball;
  std::vector<EndDistances> distances;
  for (std::size_t s = 0; s < groom.strandCount(); ++s)
    distances.push_back({found.head->distanceTo(firsts[s]), found.head->distanceTo(lasts[s])});
  const double on = kNearRms * found.head->rms + kNear * found.head->radius;
  found.isReversed = reversedBy(distances, on, 2 * on);
  return found;
}

void turnRound(const std::vector<bool>& which, Groom& groom) {
  RINGLET_ASSERT(which.size() == groom.strandCount(), "a choice for every strand");
  for (std::size_t s = 0; s < which.size(); ++s) {
    if (which[s])
      std::reverse(groom.points.begin() + groom.firstPoint[s],
                   groom.points.begin() + groom.firstPoint[s + 1]);
  }
}

}  // namespace ringlet
