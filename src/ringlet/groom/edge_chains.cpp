// Implements groom/edge_chains.h.
#include "ringlet/groom/edge_chains.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "ringlet/base/assert.h"

namespace ringlet {
namespace {

constexpr std::size_t kNone = static_cast<std::size_t>(-1);
using Ends = std::array<std::size_t, 2>;  // the edges at a point

// The edges at every point, two at most.
Result<std::vector<Ends>> edgesAtPoints(std::span<const ListedEdge> edges, std::size_t pointCount,
                                        const std::string& fileName) {
  std::vector<Ends> ends(pointCount, Ends{kNone, kNone});
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const ListedEdge& edge = edges[e];
    RINGLET_ASSERT(edge.from < pointCount && edge.to < pointCount,
                   "joinEdges needs indices below pointCount");
    if (edge.from == edge.to) {
      return Error{
          fmt::format("{}: line {}: found an edge from point {} to itself; expected two different points",
                      fileName, edge.line, edge.from + 1)};
    }
    for (std::uint32_t point : {edge.from, edge.to}) {
      if (ends[point][1] != kNone) {
        return Error{
            fmt::format("{}: line {}: found a third edge at point {}; expected strands, which do not branch",
                        fileName, edge.line, point + 1)};
      }
      ends[point][ends[point][0] == kNone ? 0 : 1] = e;
    }
  }
  return ends;
}

}  // namespace

Result<std::vector<EdgeChain>> joinEdges(std::span<const ListedEdge> edges, std::size_t pointCount,
                                         const std::string& fileName) {
  const Result<std::vector<Ends>> ends = edgesAtPoints(edges, pointCount, fileName);
  if (!ends) return ends.error();

  // Walk from every end of a chain to the other, once.
  std::vector<bool> isTaken(edges.size(), false);
  std::vector<EdgeChain> chains;
  for (const ListedEdge& start : edges) {
    for (std::uint32_t end : {start.from, start.to}) {
      if ((*ends)[end][1] != kNone || isTaken[(*ends)[end][0]]) continue;
      EdgeChain chain;
      chain.points.push_back(end);
      std::size_t forward = 0, firstEdge = kNone;
      bool isFirstForward = true;
      std::uint32_t point = end;
      for (std::size_t e = (*ends)[end][0]; e != kNone;) {
        isTaken[e] = true;
        const bool isForward = edges[e].from == point;
        forward += isForward;
        if (e < firstEdge) {
          firstEdge = e;
          isFirstForward = isForward;
        }
        point = isForward ? edges[e].to : edges[e].from;
        chain.points.push_back(point);
        const Ends& next = (*ends)[point];
        e = next[0] == e ? next[1] : next[0];
      }

      // The root is where most edges come from.
      const std::size_t count = chain.points.size() - 1;
      const bool isBackward = 2 * forward < count || (2 * forward == count && !isFirstForward);
      if (isBackward) std::reverse(chain.points.begin(), chain.points.end());
      chain.firstLine = edges[firstEdge].line;
      chain.isOneDirection = forward == 0 || forward == count;
      chains.push_back(std::move(chain));
    }
  }

  // What no walk reached has no end.
  const auto left = std::find(isTaken.begin(), isTaken.end(), false);
  if (left != isTaken.end()) {
    return Error{fmt::format(
        "{}: line {}: found an edge of a closed loop; expected strands, which have a root and a tip",
        fileName, edges[static_cast<std::size_t>(left - isTaken.begin())].line)};
  }
  std::sort(chains.begin(), chains.end(),
            [](const EdgeChain& a, const EdgeChain& b) { return a.firstLine < b.firstLine; });
  return chains;
}

}  // namespace ringlet
