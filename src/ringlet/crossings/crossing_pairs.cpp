// Implements crossings/crossing_pairs.h.
#include "ringlet/crossings/crossing_pairs.h"

#include <algorithm>
#include <utility>

#include "ringlet/base/bounds.h"
#include "ringlet/base/box_pairs.h"
#include "ringlet/base/in_parallel.h"

namespace ringlet {
namespace {

struct SweptEdges {
  std::vector<std::uint32_t> first, strands;
  std::vector<Box> boxes;  // that they sweep, widened
};

bool isFinite(const CrossingWays& ways, std::size_t i) {
  return ringlet::isFinite(ways.from[i]) && ringlet::isFinite(ways.to[i]);
}

Vec3d meanWay(const CrossingWays& ways) {
  Vec3d sum;
  double count = 0;
  for (std::size_t i = 0; i < ways.from.size(); ++i)
    if (isFinite(ways, i)) sum += ways.to[i] - ways.from[i], ++count;
  return sum / std::max(count, 1.0);
}

// Of edges that are finite.
SweptEdges sweptEdges(const CrossingHair& hair, const CrossingWays& ways, double widening) {
  SweptEdges edges;
  const Vec3d mean = meanWay(ways);
  for (std::uint32_t s = 0; s + 1 < hair.firstPoint.size(); ++s) {
    if (!hair.takes(s)) continue;
    for (std::uint32_t i = hair.firstPoint[s]; i + 1 < hair.firstPoint[s + 1]; ++i) {
      if (!isFinite(ways, i) || !isFinite(ways, i + 1)) continue;
      Bounds bounds = Bounds::none();
      for (const std::uint32_t end : {i, i + 1})
        for (const Vec3d& x : {ways.from[end], ways.to[end] - mean}) bounds.add(x);
      const Vec3d half = (bounds.high - bounds.low) * 0.5;
      edges.first.push_back(i), edges.strands.push_back(s);
      edges.boxes.push_back({bounds.middle(), half + Vec3d{widening, widening, widening}});
    }
  }
  return edges;
}

// Whether planes across the direction between the nearest points part two edges for as long as their ends
// stay within the reach of these ways.
bool stayParted(const EdgeWay& p, const EdgeWay& q, const NearestOfEdges& at, double reach, double gap) {
  return partedAlong(at.normal, p.from, q.from) > 0 && partedAlong(at.normal, p.to, q.to) > 2 * reach + gap;
}

constexpr std::size_t kEdgesOfPart = 256;  // that a thread looks at in one go

}  // namespace

std::vector<EdgePair> listCrossingPairs(const CrossingHair& hair, const CrossingWays& ways, double reach,
                                        double gap, double leastGap) {
  const SweptEdges edges = sweptEdges(hair, ways, reach + gap);
  const BoxPairs boxes(edges.boxes);
  const std::size_t count = edges.first.size();
  std::vector<std::vector<EdgePair>> found(count / kEdgesOfPart + 1);
  const auto look = [&](std::size_t i, std::vector<EdgePair>& list) {
    boxes.visitPartners(i, [&](std::size_t j) {
      if (!hair.mayMeet(edges.strands[i], edges.strands[j])) return;
      const std::uint32_t p = edges.first[std::min(i, j)], q = edges.first[std::max(i, j)];
      if (hair.isGiven(p) && hair.isGiven(q)) return;
      const EdgeWay ofP = ways.of(p), ofQ = ways.of(q);
      const NearestOfEdges at = nearestOfEdges(ofP.from, ofQ.from);
      if (!stayParted(ofP, ofQ, at, reach, gap)) list.push_back({p, q, demandOf(at.gap, gap, leastGap)});
    });
  };
  SharedParts parts(count, kEdgesOfPart);
  inParallel(static_cast<unsigned>(std::min<std::size_t>(found.size(), coreCount())), [&] {
    parts.take([&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) look(i, found[begin / kEdgesOfPart]);
    });
  });
  std::vector<EdgePair> list;
  for (const std::vector<EdgePair>& some : found) list.insert(list.end(), some.begin(), some.end());
  std::ranges::sort(list, {}, [](const EdgePair& pair) { return std::pair(pair.p, pair.q); });
  return list;
}

}  // namespace ringlet
