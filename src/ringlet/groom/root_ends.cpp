// Implements groom/root_ends.h.
#include "ringlet/groom/root_ends.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "ringlet/base/assert.h"
#include "ringlet/groom/stray_points.h"

namespace ringlet {
namespace {

constexpr std::size_t kLeastStrands = 8;  // of fewer a ball goes through nearly any ends
constexpr std::size_t kLeastForOutliers = 20;
constexpr double kLeastOn = 0.8;      // share of strands with an end where roots stand
constexpr double kCounted = 0.7;      // of the ends, the nearest; others may be of strands turned round
constexpr int kFits = 8;              // each without the farthest of the one before
constexpr double kMostUneven = 0.06;  // of ends from a head's ball, rms over its radius
constexpr double kNearRms = 3, kNear = 0.03;  // of the ball: so many rms, and this share of its radius
constexpr std::size_t kMostSampled = 4000;    // of particles
// Hair spreads out from a head: where its first and its last ends are on balls, the head is the smaller. Not
// one smaller than this share of the other, a knot into which hair is gathered, nor one that is less even.
constexpr double kLeastOfOther = 0.4, kAsEven = 0.01;
// Where first ends are on none, any other ball is so much more even than the one that fits them best, if hair
// is around that: they may be on a small patch of a head.
constexpr double kMoreEven = 0.5;
// A ball through one end of each strand, whichever: from every choice of ends of a few strands, then through
// the nearer end of most; of a groom a sample. It counts where it is very even, and more so than the ball
// through first or last ends: with a choice of two, ends lie near some ball or other, of few strands even
// more.
constexpr std::size_t kChosen = 6, kSets = 3, kMostTried = 200;
constexpr int kTurns = 12;
constexpr double kNearer = 0.9, kVeryEven = 0.01, kVeryEvenOfFew = 0.003;

double unevenness(const Ball& ball) { return ball.rms / ball.radius; }

// Evenly spread, at most so many.
std::vector<Vec3d> sampleOf(std::span<const Vec3f> points, std::size_t most) {
  std::vector<Vec3d> sample;
  const std::size_t step = (points.size() + most - 1) / most;
  for (std::size_t i = 0; i < points.size(); i += step) sample.emplace_back(points[i]);
  return sample;
}

class HeadFinder {
 public:
  HeadFinder(const StrandEnds& ends, std::span<const Vec3f> particles)
      : ends_(ends), particles_(sampleOf(particles, kMostSampled)) {}

  // On which most strands have their first ends, or their last, or either.
  std::optional<Ball> find() const {
    const Found first = throughMost(ends_.first), last = throughMost(ends_.last);
    std::optional<Ball> head;
    if (first.isHead) {
      head = first.ball;
      const bool isSmaller =
          last.ball.radius < head->radius && last.ball.radius > kLeastOfOther * head->radius;
      if (last.isHead && isSmaller && unevenness(last.ball) < unevenness(*head) + kAsEven) head = last.ball;
    } else if (last.isHead && isMoreEven(last.ball, first.ball)) {
      head = last.ball;
    }
    const auto either = headOfEither();
    if (!either || !isMoreEven(*either, head.value_or(first.ball))) return head;
    return !head || either->radius < (1 + kVeryEven) * head->radius ? either : head;
  }

 private:
  struct Found {
    Ball ball;
    bool isHead = false;
  };

  bool isMoreEven(const Ball& ball, const Ball& other) const {
    return !(other.radius > 0 && hasHairAround(other)) || unevenness(ball) < kMoreEven * unevenness(other);
  }

  // Rather than in it, which tells the head from a ball that goes through tips.
  bool hasHairAround(const Ball& ball) const {
    double sum = 0;
    for (const Vec3d& p : particles_) sum += length(p - ball.middle) - ball.radius;
    return sum > 0;
  }

  // The ball through most of them, and whether it is a head.
  Found throughMost(const std::vector<Vec3d>& ends) const {
    if (ends.size() < kLeastStrands) return {};
    std::vector<Vec3d> counted = ends;
    Ball ball = ballThrough(counted);
    if (ends.size() >= kLeastForOutliers) {
      const auto keep = static_cast<std::ptrdiff_t>(kCounted * static_cast<double>(ends.size()));
      std::vector<Vec3d> order = ends;
      for (int fit = 0; fit < kFits && ball.radius > 0; ++fit) {
        std::ranges::nth_element(order, order.begin() + keep, {},
                                 [&](Vec3d p) { return ball.distanceTo(p); });
        counted.assign(order.begin(), order.begin() + keep);
        ball = ballThrough(counted);
      }
    }
    return {ball, isHead(ball, counted, kMostUneven) && hasHairAround(ball)};
  }

  // From a guess: through the nearer ends of most strands, again and again.
  std::optional<Ball> settled(Ball ball, const StrandEnds& some) const {
    std::vector<Vec3d> nearer(some.first.size());
    const auto keep = static_cast<std::size_t>(kNearer * static_cast<double>(nearer.size()));
    const auto counted = std::span(nearer).first(keep);
    for (int turn = 0; turn < kTurns; ++turn) {
      if (!(ball.radius > 0)) return std::nullopt;
      for (std::size_t s = 0; s < nearer.size(); ++s)
        nearer[s] =
            ball.distanceTo(some.first[s]) < ball.distanceTo(some.last[s]) ? some.first[s] : some.last[s];
      std::ranges::nth_element(nearer, nearer.begin() + static_cast<std::ptrdiff_t>(keep), {},
                               [&](Vec3d p) { return ball.distanceTo(p); });
      ball = ballThrough(counted);
    }
    const double most = nearer.size() < kLeastForOutliers ? kVeryEvenOfFew : kVeryEven;
    return isHead(ball, counted, most) && hasHairAround(ball) ? std::optional(ball) : std::nullopt;
  }

  // The smallest that goes through an end of nearly every strand, first or last, but for knots.
  std::optional<Ball> headOfEither() const {
    const std::size_t strands = ends_.first.size();
    if (strands < kLeastStrands) return std::nullopt;
    StrandEnds some;
    const std::size_t step = (strands + kMostTried - 1) / kMostTried;
    for (std::size_t s = 0; s < strands; s += step) {
      some.first.push_back(ends_.first[s]);
      some.last.push_back(ends_.last[s]);
    }
    std::vector<Ball> balls;
    for (std::size_t set = 0; set < kSets; ++set) {
      for (std::size_t choice = 0; choice < (std::size_t{1} << kChosen); ++choice) {
        std::vector<Vec3d> chosen;
        for (std::size_t k = 0; k < kChosen; ++k) {
          const std::size_t s = (set + k * some.first.size() / kChosen) % some.first.size();
          chosen.push_back((choice >> k) & 1 ? some.last[s] : some.first[s]);
        }
        if (const auto ball = settled(ballThrough(chosen), some)) balls.push_back(*ball);
      }
    }
    if (balls.empty()) return std::nullopt;
    const double largest = std::ranges::max(balls, {}, &Ball::radius).radius;
    std::erase_if(balls, [&](const Ball& ball) { return ball.radius < kLeastOfOther * largest; });
    return std::ranges::min(balls, {}, &Ball::radius);
  }

  const StrandEnds& ends_;
  std::vector<Vec3d> particles_;
};

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

std::vector<Vec3d> rootPlaces(const Groom& groom) {
  std::vector<Vec3d> roots;
  for (std::size_t s = 0; s < groom.strandCount(); ++s)
    roots.push_back(Vec3d(groom.strand(s).front()) * groom.metresPerUnit);
  return roots;
}

StrandEnds strandEnds(const Groom& groom) {
  const std::vector<bool> isStray = strayPoints(groom);
  StrandEnds ends;
  for (std::size_t s = 0; s < groom.strandCount(); ++s) {
    std::size_t first = groom.firstPoint[s], last = groom.firstPoint[s + 1] - 1;  // two are no strays
    while (isStray[first]) ++first;
    while (isStray[last]) --last;
    ends.first.emplace_back(groom.points[first]);
    ends.last.emplace_back(groom.points[last]);
  }
  return ends;
}

RootEnds findRootEnds(const Groom& groom) {
  RootEnds found;
  found.isReversed.assign(groom.strandCount(), false);
  const StrandEnds ends = strandEnds(groom);
  found.head = HeadFinder(ends, groom.points).find();
  if (!found.head) return found;
  std::vector<EndDistances> distances;
  for (std::size_t s = 0; s < groom.strandCount(); ++s)
    distances.push_back({found.head->distanceTo(ends.first[s]), found.head->distanceTo(ends.last[s])});
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
