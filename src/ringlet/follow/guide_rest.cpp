// Implements follow/guide_rest.h.
#include "ringlet/follow/guide_rest.h"

#include <algorithm>
#include <iterator>

#include "ringlet/groom/curl_shape.h"

namespace ringlet {

GuideRest restOfGuide(std::span<const Vec3d> strand) {
  GuideRest rest;
  rest.arcs = arcPositions(strand);
  rest.window = coreWindow(measureCurl(strand), rest.arcs.back());
  rest.root = strand.front();
  const std::vector<Vec3d> core = smoothCore(strand, rest.arcs, rest.window);
  rest.frame = rootFrameOf(core);
  for (std::size_t k = 0; k < rest.way.size(); ++k)
    rest.way[k] = core[(k + 1) * (core.size() - 1) / rest.way.size()] - core.front();
  return rest;
}

double partingOf(const GuideRest& a, const GuideRest& b) {
  double most = 0;
  for (std::size_t k = 0; k < a.way.size(); ++k) {
    const Vec3d there = normalizedOr(a.way[k], {}), its = normalizedOr(b.way[k], {});
    most = std::max(most, length(there - its));
  }
  return most;
}

std::vector<GuidePiece> piecesOf(const GuideRest& guide) {
  std::vector<GuidePiece> pieces;
  std::size_t begin = 0;
  for (std::size_t k = 0; k <= guide.pieces.size(); ++k) {
    const std::size_t end = k < guide.pieces.size() ? guide.pieces[k] : guide.arcs.size();
    pieces.push_back({begin, end, std::min(guide.window, guide.arcs[end - 1] - guide.arcs[begin])});
    begin = end;
  }
  return pieces;
}

std::vector<double> arcsOf(const GuideRest& guide, const GuidePiece& piece) {
  std::vector<double> arcs;
  for (std::size_t i = piece.begin; i < piece.end; ++i)
    arcs.push_back(guide.arcs[i] - guide.arcs[piece.begin]);
  return arcs;
}

// Each component's square is a sum of the matrix's diagonal; the largest is divided by.
Quatd quaternionOf(const MeasuringFrame& frame) {
  const auto& [x, y, z] = frame;  // columns
  const double squares[] = {1 + x.x - y.y - z.z, 1 - x.x + y.y - z.z, 1 - x.x - y.y + z.z,
                            1 + x.x + y.y + z.z};
  const Quatd ways[] = {{squares[0], x.y + y.x, z.x + x.z, y.z - z.y},
                        {x.y + y.x, squares[1], y.z + z.y, z.x - x.z},
                        {z.x + x.z, y.z + z.y, squares[2], x.y - y.x},
                        {y.z - z.y, z.x - x.z, x.y - y.x, squares[3]}};
  return normalized(ways[std::max_element(std::begin(squares), std::end(squares)) - std::begin(squares)]);
}

}  // namespace ringlet
