// Implements rest/contact_graph.h.
#include "ringlet/rest/contact_graph.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "ringlet/groom/seeded_random.h"

namespace ringlet {
namespace {

void dropWeak(std::vector<StrandOverlap>& overlaps, int minOverlaps) {
  std::erase_if(overlaps,
                [&](const StrandOverlap& o) { return o.count < static_cast<std::uint32_t>(minOverlaps); });
}

// Marks the pairs that are beyond maxNeighbours for one of their strands, ordered from strongest to weakest.
void keepStrongest(std::vector<StrandOverlap>& overlaps, const RestState& rest, int maxNeighbours) {
  struct End {
    std::uint32_t strand, count, otherInGroom, overlap;
  };
  std::vector<End> ends;
  for (std::uint32_t k = 0; k < overlaps.size(); ++k) {
    const StrandOverlap& o = overlaps[k];
    ends.push_back({o.a, o.count, rest.strandInGroom[o.b], k});
    ends.push_back({o.b, o.count, rest.strandInGroom[o.a], k});
  }
  std::sort(ends.begin(), ends.end(), [](const End& x, const End& y) {
    if (x.strand != y.strand) return x.strand < y.strand;
    return x.count != y.count ? x.count > y.count : x.otherInGroom < y.otherInGroom;
  });
  int rank = 0;
  for (std::size_t e = 0; e < ends.size(); ++e) {
    rank = e > 0 && ends[e].strand == ends[e - 1].strand ? rank + 1 : 0;
    if (rank >= maxNeighbours) overlaps[ends[e].overlap].count = 0;
  }
  dropWeak(overlaps, 1);
}

void dropAtRandom(std::vector<StrandOverlap>& overlaps, const RestState& rest, double share,
                  std::uint32_t seed) {
  std::erase_if(overlaps, [&](const StrandOverlap& o) {
    const auto [low, high] = std::minmax(rest.strandInGroom[o.a], rest.strandInGroom[o.b]);
    return SeededRandom(seed, std::uint64_t{low} << 32 | high).uniform() < share;
  });
}

std::uint64_t sumOfCounts(std::span<const StrandOverlap> overlaps) {
  return std::accumulate(overlaps.begin(), overlaps.end(), std::uint64_t{0},
                         [](std::uint64_t sum, const StrandOverlap& o) { return sum + o.count; });
}

// Overlaps are sorted by a, then b, so each strand gets first the neighbours below it, then those above, each
// ascending.
void connect(ContactGraph& graph, std::span<const StrandOverlap> overlaps, std::size_t strandCount) {
  graph.firstNeighbour.assign(strandCount + 1, 0);
  for (const StrandOverlap& o : overlaps) ++graph.firstNeighbour[o.a + 1], ++graph.firstNeighbour[o.b + 1];
  std::partial_sum(graph.firstNeighbour.begin(), graph.firstNeighbour.end(), graph.firstNeighbour.begin());
  graph.neighbours.resize(2 * overlaps.size());
  std::vector<std::uint32_t> next(graph.firstNeighbour.begin(), graph.firstNeighbour.end() - 1);
  graph.counts.resize(2 * overlaps.size());
  const auto add = [&](std::uint32_t strand, std::uint32_t other, std::uint32_t count) {
    graph.counts[next[strand]] = count;
    graph.neighbours[next[strand]++] = other;
  };
  for (const StrandOverlap& o : overlaps) add(o.b, o.a, o.count);
  for (const StrandOverlap& o : overlaps) add(o.a, o.b, o.count);
}

}  // namespace

bool ContactGraph::allows(std::uint32_t a, std::uint32_t b) const {
  if (everyPair) return a != b;
  const auto begin = neighbours.begin();
  return std::binary_search(begin + firstNeighbour[a], begin + firstNeighbour[a + 1], b);
}

ContactGraph pruneStrandPairs(std::span<const StrandOverlap> overlaps, const RestState& rest,
                              const ContactSettings& settings) {
  ContactGraph graph;
  graph.everyPair = !settings.prunePairs;
  graph.pairsUnpruned = overlaps.size();
  graph.overlapsUnpruned = sumOfCounts(overlaps);
  if (graph.everyPair) {
    graph.pairs = graph.pairsUnpruned;
    graph.overlaps = graph.overlapsUnpruned;
    return graph;
  }
  std::vector<StrandOverlap> left(overlaps.begin(), overlaps.end());
  dropWeak(left, settings.minOverlaps);
  if (settings.maxNeighbours > 0) keepStrongest(left, rest, settings.maxNeighbours);
  if (settings.dropShare > 0) dropAtRandom(left, rest, settings.dropShare, settings.seed);
  graph.pairs = left.size();
  graph.overlaps = sumOfCounts(left);
  connect(graph, left, rest.strands.size());
  if (graph.pairs == 0 && rest.strands.size() > 1) {
    graph.warnings.push_back(fmt::format(
        "no two of {} strands may touch: of {} pairs that overlap at rest none is left after pruning; prune "
        "less, or not at all where strands that are apart at rest shall meet",
        rest.strands.size(), graph.pairsUnpruned));
  }
  return graph;
}

}  // namespace ringlet
