// Joins single edges into chains, for files that hold one line per edge.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "ringlet/groom/left_out.h"

namespace ringlet {

/// An edge between two points, as a line of a file names it.
struct ListedEdge {
  std::uint32_t from, to;  // indices of points, from 0
  std::size_t line;        // where it stands, for messages
};

/// The points along one chain, in the direction of most of its edges (of the first listed, if as many run
/// either way).
struct EdgeChain {
  std::vector<std::uint32_t> points;
  std::size_t firstLine = 0;    // of its edges, the first listed
  bool isOneDirection = false;  // all its edges run the same way
};

struct JoinedEdges {
  std::vector<EdgeChain> chains;  // in order of their first lines
  LeftOutStrands leftOut;         // what hangs together and is no strand: branches, closed loops
};

/// Joins edges that share a point; all indices must be below pointCount. Edges that hang together and branch,
/// close a loop or go from a point to itself are left out, with the line of the first. Cost: linear in edges
/// and points.
JoinedEdges joinEdges(std::span<const ListedEdge> edges, std::size_t pointCount);

}  // namespace ringlet
