// Implements rest/rest_curve.h.
#include "ringlet/rest/rest_curve.h"

namespace ringlet {
namespace {

Quatd smallestRotation(Vec3d a, Vec3d b) {
  double c = 1 + dot(a, b);
  if (c < 1e-6) {
    Vec3d axis = anyNormal(a);
    return {axis.x, axis.y, axis.z, 0};
  }
  Vec3d axis = cross(a, b);
  return normalized(Quatd{axis.x, axis.y, axis.z, c});
}

}  // namespace

std::vector<Vec3d> smoothEdges(std::span<const Vec3d> edges, double beta) {
  std::vector<Vec3d> smoothed;
  smoothed.reserve(edges.size());
  Vec3d a = edges.empty() ? Vec3d{} : edges[0], d = a;
  for (Vec3d edge : edges) {
    a += (edge - a) * beta;
    d += (a - d) * beta;
    smoothed.push_back(d);
  }
  return smoothed;
}

std::vector<Quatd> framesBeforeEdges(std::span<const Vec3d> smoothedEdges, Vec3d firstEdge) {
  std::vector<Quatd> frames;
  frames.reserve(smoothedEdges.size());
  Quatd frame;
  Vec3d direction = normalizedOr(firstEdge, Vec3d{});
  for (Vec3d d : smoothedEdges) {
    frames.push_back(frame);
    Vec3d next = normalizedOr(d, direction);
    frame = normalized(smallestRotation(direction, next) * frame);
    direction = next;
  }
  return frames;
}

}  // namespace ringlet
