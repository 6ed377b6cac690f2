// Implements measure/rest_crossings.h.
#include "ringlet/measure/rest_crossings.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "ringlet/base/box_pairs.h"
#include "ringlet/groom/root_ends.h"
#include "ringlet/rest/root_spacing.h"

namespace ringlet {
namespace {

constexpr double kMostCompared = 2000;                    // boxes of an edge, on average
constexpr std::size_t kSampled = 256;                     // edges, to know that
constexpr double kNearRoot = 2;                           // widths
constexpr std::size_t kMostPairs = std::size_t{1} << 24;  // of strands: 128 MiB of them

struct RestEdge {
  Vec3d from, along;
  std::uint32_t strand;
};

// Ericson, "Real-Time Collision Detection", 2005, section 5.1.9.
double distanceBetween(const RestEdge& p, const RestEdge& q) {
  const Vec3d apart = p.from - q.from;
  const double aa = dot(p.along, p.along), cc = dot(q.along, q.along), ac = dot(p.along, q.along);
  const double a = dot(p.along, apart), c = dot(q.along, apart);
  const double determinant = aa * cc - ac * ac;
  double onP = 0;
  if (determinant > 1e-12 * aa * cc) onP = std::clamp((ac * c - a * cc) / determinant, 0.0, 1.0);
  double onQ = cc > 0 ? (ac * onP + c) / cc : 0;
  if (onQ < 0 || onQ > 1) {
    onQ = std::clamp(onQ, 0.0, 1.0);
    onP = aa > 0 ? std::clamp((ac * onQ - a) / aa, 0.0, 1.0) : 0;
  }
  return length(apart + p.along * onP - q.along * onQ);
}

std::vector<RestEdge> edgesAwayFromRoots(const Groom& groom, double least) {
  std::vector<RestEdge> edges;
  for (std::size_t s = 0; s < groom.strandCount(); ++s) {
    const std::span<const Vec3f> strand = groom.strand(s);
    double along = 0;
    for (std::size_t i = 0; i + 1 < strand.size(); ++i) {
      const auto from = Vec3d(strand[i]), way = Vec3d(strand[i + 1]) - from;
      if (along >= least) edges.push_back({from, way, static_cast<std::uint32_t>(s)});
      along += length(way);
    }
  }
  return edges;
}

bool isTooDense(const BoxPairs& pairs, std::size_t edges) {
  const std::size_t step = edges / kSampled + 1;
  std::size_t sampled = 0, compared = 0;
  for (std::size_t i = 0; i < edges; i += step, ++sampled) compared += pairs.comparedCount(i);
  return static_cast<double>(compared) > kMostCompared * static_cast<double>(sampled);
}

// Keeps of each pair of strands one word, whether they cross.
class StrandPairs {
 public:
  void add(std::uint32_t a, std::uint32_t b, bool isCrossing) {
    const auto [low, high] = std::minmax(a, b);
    pairs_.push_back(((static_cast<std::uint64_t>(low) << 32 | high) << 1) | (isCrossing ? 0 : 1));
    if (pairs_.size() > most_) settle();
  }
  bool areTooMany() const { return most_ > 2 * kMostPairs; }

  void count(std::size_t strands, RestCrossings& found) {
    settle();
    std::vector<bool> isCrossing(strands, false);
    for (const std::uint64_t pair : pairs_) {
      ++found.overlappingPairs;
      if (pair & 1) continue;
      ++found.pairs;
      isCrossing[pair >> 33] = isCrossing[pair >> 1 & 0xffffffffu] = true;
    }
    found.strands = static_cast<std::size_t>(std::ranges::count(isCrossing, true));
    if (found.strands > 0)
      found.firstStrand = static_cast<std::size_t>(std::ranges::find(isCrossing, true) - isCrossing.begin());
  }

 private:
  // Sorted, a pair that crosses is before the same pair that only overlaps.
  void settle() {
    std::ranges::sort(pairs_);
    const auto isSame = [](std::uint64_t a, std::uint64_t b) { return a >> 1 == b >> 1; };
    pairs_.erase(std::unique(pairs_.begin(), pairs_.end(), isSame), pairs_.end());
    most_ = std::max(kMostPairs / 4, 2 * pairs_.size());
  }

  std::vector<std::uint64_t> pairs_;
  std::size_t most_ = kMostPairs / 4;
};

}  // namespace

std::optional<RestCrossings> restCrossings(const Groom& groom) {
  RestCrossings found;
  found.width = meanNearestDistance(rootPlaces(groom)) / groom.metresPerUnit;
  if (!(found.width > 0) || !std::isfinite(found.width)) return std::nullopt;
  const std::vector<RestEdge> edges = edgesAwayFromRoots(groom, kNearRoot * found.width);
  std::vector<Box> boxes;
  for (const RestEdge& edge : edges) {
    const Vec3d half = edge.along * 0.5;
    const double more = found.width / 2;
    boxes.push_back(
        {edge.from + half, {std::abs(half.x) + more, std::abs(half.y) + more, std::abs(half.z) + more}});
  }
  const BoxPairs pairs(boxes);
  if (isTooDense(pairs, edges.size())) return std::nullopt;
  StrandPairs near;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (near.areTooMany()) return std::nullopt;
    pairs.visitPartners(i, [&](std::size_t j) {
      if (edges[i].strand == edges[j].strand) return;
      const double distance = distanceBetween(edges[i], edges[j]);
      if (distance < found.width)
        near.add(edges[i].strand, edges[j].strand, distance < kCrossingShare * found.width);
    });
  }
  near.count(groom.strandCount(), found);
  return found;
}

}  // namespace ringlet
