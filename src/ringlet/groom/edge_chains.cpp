// Implements groom/edge_chains.h.
#include "ringlet/groom/edge_chains.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

#include "ringlet/base/assert.h"

namespace ringlet {
namespace {

constexpr std::size_t kNone = static_cast<std::size_t>(-1);
using Ends = std::array<std::size_t, 2>;  // the edges at a point

// Which points hang together by edges.
class Parts {
 public:
  explicit Parts(std::size_t pointCount) : above_(pointCount) {
    std::iota(above_.begin(), above_.end(), std::uint32_t{0});
  }
  // The point that stands for all of its part.
  std::uint32_t of(std::uint32_t point) {
    for (; above_[point] != point; point = above_[point]) above_[point] = above_[above_[point]];
    return point;
  }
  void join(std::uint32_t a, std::uint32_t b) { above_[of(a)] = of(b); }

 private:
  std::vector<std::uint32_t> above_;
};

class EdgeJoiner {
 public:
  EdgeJoiner(std::span<const ListedEdge> edges, std::size_t pointCount)
      : edges_(edges),
        parts_(pointCount),
        ends_(pointCount, Ends{kNone, kNone}),
        isBad_(pointCount, false),
        isTaken_(edges.size(), false) {}

  JoinedEdges join() {
    for (std::size_t e = 0; e < edges_.size(); ++e) noteEdge(e);
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      for (const std::uint32_t end : {edges_[e].from, edges_[e].to}) {
        if (!isOfStrand(e) || isTaken_[e] || ends_[end][1] != kNone) continue;
        joined_.chains.push_back(walkFrom(end));
      }
    }
    // What no walk reached has no end.
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      if (!isOfStrand(e) || isTaken_[e]) continue;
      leaveOut(e, "an edge of a closed loop", "strands, which have a root and a tip");
    }
    std::ranges::sort(joined_.chains, {}, &EdgeChain::firstLine);
    return std::move(joined_);
  }

 private:
  bool isOfStrand(std::size_t e) {
    return edges_[e].from != edges_[e].to && !isBad_[parts_.of(edges_[e].from)];
  }
  // One more that is left out; the topmost of the file is told.
  void note(std::size_t line, const std::string& what, const char* expected) {
    ++joined_.leftOut.count;
    if (line >= firstLine_) return;
    firstLine_ = line;
    joined_.leftOut.first = fmt::format("line {}: found {}; expected {}", line, what, expected);
  }
  // All that hangs together with the edge.
  void leaveOut(std::size_t e, const std::string& what, const char* expected) {
    note(edges_[e].line, what, expected);
    isBad_[parts_.of(edges_[e].from)] = true;
  }

  void noteEdge(std::size_t e) {
    const ListedEdge& edge = edges_[e];
    RINGLET_ASSERT(edge.from < ends_.size() && edge.to < ends_.size(),
                   "joinEdges needs indices below pointCount");
    if (edge.from == edge.to) {
      note(edge.line, fmt::format("an edge from point {} to itself", edge.from + 1), "two different points");
      return;
    }
    const bool wasBad = isBad_[parts_.of(edge.from)] || isBad_[parts_.of(edge.to)];
    parts_.join(edge.from, edge.to);
    isBad_[parts_.of(edge.from)] = wasBad;
    for (const std::uint32_t point : {edge.from, edge.to}) {
      if (ends_[point][1] == kNone) {
        ends_[point][ends_[point][0] == kNone ? 0 : 1] = e;
      } else if (!isBad_[parts_.of(point)]) {
        leaveOut(e, fmt::format("a third edge at point {}", point + 1), "strands, which do not branch");
      }
    }
  }

  // From one end of a chain to the other.
  EdgeChain walkFrom(std::uint32_t end) {
    EdgeChain chain;
    chain.points.push_back(end);
    std::size_t forward = 0, firstEdge = kNone;
    bool isFirstForward = true;
    std::uint32_t point = end;
    for (std::size_t e = ends_[end][0]; e != kNone;) {
      isTaken_[e] = true;
      const bool isForward = edges_[e].from == point;
      forward += isForward;
      if (e < firstEdge) {
        firstEdge = e;
        isFirstForward = isForward;
      }
      point = isForward ? edges_[e].to : edges_[e].from;
      chain.points.push_back(point);
      const Ends& next = ends_[point];
      e = next[0] == e ? next[1] : next[0];
    }

    // The root is where most edges come from.
    const std::size_t count = chain.points.size() - 1;
    const bool isBackward = 2 * forward < count || (2 * forward == count && !isFirstForward);
    if (isBackward) std::reverse(chain.points.begin(), chain.points.end());
    chain.firstLine = edges_[firstEdge].line;
    chain.isOneDirection = forward == 0 || forward == count;
    return chain;
  }

  std::span<const ListedEdge> edges_;
  Parts parts_;
  std::vector<Ends> ends_;         // of each point
  std::vector<bool> isBad_;        // of the point that stands for a part
  std::vector<bool> isTaken_;      // of each edge, by a chain
  std::size_t firstLine_ = kNone;  // of what is left out
  JoinedEdges joined_;
};

}  // namespace

JoinedEdges joinEdges(std::span<const ListedEdge> edges, std::size_t pointCount) {
  return EdgeJoiner(edges, pointCount).join();
}

}  // namespace ringlet
