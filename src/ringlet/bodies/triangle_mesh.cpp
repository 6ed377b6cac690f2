// Implements bodies/triangle_mesh.h.
#include "ringlet/bodies/triangle_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <compare>
#include <numeric>
#include <tuple>

namespace ringlet {
namespace {

std::tuple<double, double, double> key(Vec3d p) { return {p.x, p.y, p.z}; }

// For every point, the first one at its place.
std::vector<std::uint32_t> firstAtPlace(const std::vector<Vec3d>& points) {
  std::vector<std::uint32_t> order(points.size()), first(points.size());
  std::iota(order.begin(), order.end(), 0u);
  // Points that no triangle has may be anything; NaN would have no order, so they stay out of it.
  std::erase_if(order, [&](std::uint32_t i) {
    first[i] = i;
    return !std::isfinite(points[i].x + points[i].y + points[i].z);
  });
  std::ranges::sort(order, [&](std::uint32_t i, std::uint32_t j) {
    const auto a = key(points[i]), b = key(points[j]);
    return a != b ? a < b : i < j;
  });
  for (std::size_t k = 1; k < order.size(); ++k) {
    if (points[order[k]] == points[order[k - 1]]) first[order[k]] = first[order[k - 1]];
  }
  return first;
}

}  // namespace

Status checkMesh(const TriangleMesh& mesh) {
  if (mesh.triangles.empty()) {
    return Error{
        fmt::format("the mesh has {} points and no triangles; expected at least one", mesh.points.size())};
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::uint32_t index : mesh.triangles[t]) {
      if (index >= mesh.points.size()) {
        return Error{fmt::format("triangle {} of the mesh names point {}; expected one of its {} points", t,
                                 index, mesh.points.size())};
      }
      const Vec3d p = mesh.points[index];
      if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
        return Error{
            fmt::format("triangle {} of the mesh has point {} at ({}, {}, {}); expected finite numbers", t,
                        index, p.x, p.y, p.z)};
      }
    }
  }
  return {};
}

Bounds boundsOf(const TriangleMesh& mesh) {
  Bounds bounds = Bounds::none();
  for (const auto& triangle : mesh.triangles) {
    for (std::uint32_t index : triangle) bounds.add(mesh.points[index]);
  }
  return bounds;
}

std::size_t openEdgeCount(const TriangleMesh& mesh) {
  // An edge from its lower to its higher point, once for each triangle beside it.
  struct Side {
    std::uint32_t low, high;
    bool isForward;
    auto operator<=>(const Side&) const = default;
  };
  const std::vector<std::uint32_t> place = firstAtPlace(mesh.points);
  std::vector<Side> sides;
  sides.reserve(3 * mesh.triangles.size());
  for (const auto& triangle : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = place[triangle[i]], b = place[triangle[(i + 1) % 3]];
      if (a != b) sides.push_back({std::min(a, b), std::max(a, b), a < b});
    }
  }
  std::ranges::sort(sides);

  std::size_t open = 0;
  for (std::size_t i = 0, end = 0; i < sides.size(); i = end) {
    while (end < sides.size() && sides[end].low == sides[i].low && sides[end].high == sides[i].high) ++end;
    const bool isClosed = end - i == 2 && !sides[i].isForward && sides[i + 1].isForward;
    open += isClosed ? 0 : 1;
  }
  return open;
}

}  // namespace ringlet
