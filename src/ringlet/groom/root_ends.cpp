// Implements groom/root_ends.h.
#include "ringlet/groom/root_ends.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "ringlet/base/assert.h"
#include "ringlet/groom/seeded_random.h"

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
// A ball through one end of each strand, whichever: so many tries, each through the ends of a few strands,
// then through the nearer end of most; of a groom a sample. It counts where it is very even, and twice as
// even as the ball through first or last ends: with a choice of two, ends lie near some ball or other.
constexpr int kTries = 64, kTurns = 12;
constexpr std::size_t kPicked = 6, kMostSampled = 200;
constexpr double kNearer = 0.9, kVeryEven = 0.01, kMoreEven = 0.5;

struct HeadOfEnds {
  Ball ball;
  bool isFound = false;
};

double unevenness(const Ball& ball) { return ball.rms / ball.radius; }

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

// From a guess: through the nearer ends of most strands, again and again.
std::optional<Ball> settled(Ball ball, std::span<const Vec3d> firsts, std::span<const Vec3d> lasts) {
  std::vector<Vec3d> ends(firsts.size());
  const auto keep = static_cast<std::ptrdiff_t>(kNearer * static_cast<double>(ends.size()));
  for (int turn = 0; turn < kTurns; ++turn) {
    if (!(ball.radius > 0)) return std::nullopt;
    for (std::size_t s = 0; s < firsts.size(); ++s)
      ends[s] = ball.distanceTo(firsts[s]) < ball.distanceTo(lasts[s]) ? firsts[s] : lasts[s];
    std::ranges::nth_element(ends, ends.begin() + keep, {}, [&](Vec3d p) { return ball.distanceTo(p); });
    ball = ballThrough(std::span(ends).first(static_cast<std::size_t>(keep)));
  }
  const bool isOne = isHead(ball, std::span(ends).first(static_cast<std::size_t>(keep)), kVeryEven);
  return isOne ? std::optional(ball) : std::nullopt;
}

// The smallest that goes through an end of nearly every strand, first or last, but for knots.
std::optional<Ball> headOfEither(const std::vector<Vec3d>& firsts, const std::vector<Vec3d>& lasts) {
  if (firsts.size() < kLeastForOutliers) return std::nullopt;
  std::vector<Vec3d> someFirsts, someLasts;
  const std::size_t step = (firsts.size() + kMostSampled - 1) / kMostSampled;
  for (std::size_t s = 0; s < firsts.size(); s += step) {
    someFirsts.push_back(firsts[s]);
    someLasts.push_back(lasts[s]);
  }
  SeededRandom random(1, 0);
  std::vector<Ball> balls;
  for (int attempt = 0; attempt < kTries; ++attempt) {
    std::vector<Vec3d> picked;
    for (std::size_t k = 0; k < kPicked; ++k) {
      const auto s = static_cast<std::size_t>(random.uniform() * static_cast<double>(someFirsts.size()));
      picked.push_back(random.uniform() < 0.5 ? someFirsts[s] : someLasts[s]);
    }
    if (const auto ball = settled(ballThrough(picked), someFirsts, someLasts)) balls.push_back(*ball);
  }
  if (balls.empty()) return std::nullopt;
  const double largest = std::ranges::max(balls, {}, &Ball::radius).radius;
  std::erase_if(balls, [&](const Ball& ball) { return ball.radius < kLeastOfOther * largest; });
  return std::ranges::min(balls, {}, &Ball::radius);
}

// On which most strands have their first ends, or their last, or either.
std::optional<Ball> headOf(const std::vector<Vec3d>& firsts, const std::vector<Vec3d>& lasts) {
  const HeadOfEnds byFirsts = headOf(firsts), byLasts = headOf(lasts);
  std::optional<Ball> head;
  if (byFirsts.isFound) head = byFirsts.ball;
  if (byLasts.isFound) {
    const Ball &first = byFirsts.ball, &last = byLasts.ball;
    const bool isSmaller = last.radius < first.radius && last.radius > kLeastOfOther * first.radius;
    if (!head || (isSmaller && unevenness(last) < unevenness(first) + kAsEven)) head = last;
  }
  const auto either = headOfEither(firsts, lasts);
  if (!either) return head;
  const bool isNoLarger = !head || either->radius < (1 + kVeryEven) * head->radius;
  return isNoLarger && (!head || unevenness(*either) < kMoreEven * unevenness(*head)) ? either : head;
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
  found.head = headOf(firsts, lasts);
  if (!found.head) return found;
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
