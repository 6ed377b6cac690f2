// Implements measure/frame_turn.h.
#include "ringlet/measure/frame_turn.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ringlet/base/assert.h"
#include "ringlet/groom/curl_shape.h"
#include "ringlet/rest/rest_curve.h"
#include "ringlet/rest/strand_constants.h"

namespace ringlet {
namespace {

// The angle of the shorter rotation from one frame to another [degrees].
double degreesBetween(Quatd a, Quatd b) {
  const Quatd turn = b * a.conjugate();
  return 2 * std::atan2(length(Vec3d{turn.x, turn.y, turn.z}), std::abs(turn.w)) * 180 / std::numbers::pi;
}

// The frames of a strand's edges, relative to the head. The filter starts from the first edge at rest, which
// is therefore put before the others.
std::vector<Quatd> framesOf(std::span<const Vec3f> strand, double metresPerUnit, Vec3d firstEdge, double beta,
                            Quatd head) {
  std::vector<Vec3d> edges{firstEdge};
  for (std::size_t i = 1; i < strand.size(); ++i) {
    const Vec3d edge = (Vec3d(strand[i]) - Vec3d(strand[i - 1])) * metresPerUnit;
    edges.push_back(rotate(head.conjugate(), edge));
  }
  return framesBeforeEdges(smoothEdges(edges, beta), firstEdge);
}

}  // namespace

FrameTurn::FrameTurn(const Groom& rest, const Material& material) : firstPoint_(rest.firstPoint) {
  for (std::size_t s = 0; s < rest.strandCount(); ++s) {
    RINGLET_ASSERT(rest.strand(s).size() >= 2, "a strand has an edge");
    std::vector<Vec3d> points;
    for (Vec3f p : rest.strand(s)) points.push_back(Vec3d(p) * rest.metresPerUnit);
    std::vector<double> arcs(points.size() - 1);
    measureArcs(points, arcs);
    strands_.push_back({.firstEdge = points[1] - points[0],
                        .beta = strandConstants(strandGeometry(points, arcs), material, {}).bendBeta,
                        .frames = {}});
  }
}

void FrameTurn::look(std::span<const Vec3f> points, double metresPerUnit, Quatd head) {
  RINGLET_ASSERT(points.size() == firstPoint_.back(), "one point per particle of the groom");
  for (std::size_t s = 0; s < strands_.size(); ++s) {
    Strand& strand = strands_[s];
    const auto now = points.subspan(firstPoint_[s], firstPoint_[s + 1] - firstPoint_[s]);
    std::vector<Quatd> frames = framesOf(now, metresPerUnit, strand.firstEdge, strand.beta, head);
    for (std::size_t i = 0; i < strand.frames.size(); ++i)
      largest_ = std::max(largest_, degreesBetween(strand.frames[i], frames[i]));
    strand.frames = std::move(frames);
  }
}

}  // namespace ringlet
