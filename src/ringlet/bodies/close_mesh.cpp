// Implements bodies/close_mesh.h.
#include "ringlet/bodies/close_mesh.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

namespace ringlet {
namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;
using Side = std::pair<std::uint32_t, std::uint32_t>;  // from a point to another

// What closes the triangles: sides that caps must pass, ascending, as often as they stand here.
std::vector<Side> openSides(const Triangles& triangles) {
  struct Passed {
    Side side;  // from the lower point
    int times;  // 1, or -1 for the other direction
  };
  std::vector<Passed> all;
  for (const auto& triangle : triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = triangle[i], b = triangle[(i + 1) % 3];
      if (a != b) all.push_back({{std::min(a, b), std::max(a, b)}, a < b ? 1 : -1});
    }
  }
  std::ranges::sort(all, {}, &Passed::side);
  std::vector<Side> open;
  for (std::size_t i = 0; i < all.size();) {
    const Side side = all[i].side;
    int times = 0;
    for (; i < all.size() && all[i].side == side; ++i) times += all[i].times;
    for (; times > 0; --times) open.emplace_back(side.second, side.first);
    for (; times < 0; ++times) open.push_back(side);
  }
  std::ranges::sort(open);
  return open;
}

// For each point the one that stands for it: of points on open sides the first at the same place.
std::vector<std::uint32_t> welded(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> first(mesh.points.size());
  std::iota(first.begin(), first.end(), 0u);
  std::map<std::tuple<double, double, double>, std::uint32_t> firstAt;
  for (const auto& [from, to] : openSides(mesh.triangles)) {
    const Vec3d p = mesh.points[from];
    first[from] = firstAt.try_emplace({p.x, p.y, p.z}, from).first->second;
  }
  return first;
}

// Loops without a point twice, which the sides are made of.
std::vector<std::vector<std::uint32_t>> loopsOf(const std::vector<Side>& sides) {
  std::map<std::uint32_t, std::vector<std::uint32_t>> onwards;
  for (auto side = sides.rbegin(); side != sides.rend(); ++side) onwards[side->first].push_back(side->second);
  std::vector<std::vector<std::uint32_t>> loops;
  for (const Side& side : sides) {
    std::vector<std::uint32_t> way;
    for (std::uint32_t at = side.first;;) {
      const auto seen = std::ranges::find(way, at);
      if (seen != way.end()) {
        loops.emplace_back(seen, way.end());
        way.erase(seen, way.end());
      }
      std::vector<std::uint32_t>& next = onwards[at];
      if (next.empty()) break;
      way.push_back(at);
      at = next.back();
      next.pop_back();
    }
  }
  return loops;
}

}  // namespace

ClosedMesh closed(const TriangleMesh& mesh) {
  constexpr std::uint32_t kNone = ~0u;
  const std::vector<std::uint32_t> first = welded(mesh);
  ClosedMesh made;
  std::vector<std::uint32_t> own(mesh.points.size(), kNone);
  for (const auto& triangle : mesh.triangles) {
    std::array<std::uint32_t, 3> corners;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t source = first[triangle[i]];
      if (own[source] == kNone) {
        own[source] = static_cast<std::uint32_t>(made.sources.size());
        made.sources.push_back(source);
      }
      corners[i] = own[source];
    }
    if (corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0])
      made.triangles.push_back(corners);
  }
  made.rims = loopsOf(openSides(made.triangles));
  for (std::size_t r = 0; r < made.rims.size(); ++r) {
    const auto& rim = made.rims[r];
    const auto middle = static_cast<std::uint32_t>(made.sources.size() + r);
    for (std::size_t i = 0; i < rim.size(); ++i)
      made.triangles.push_back({rim[i], rim[(i + 1) % rim.size()], middle});
  }
  return made;
}

}  // namespace ringlet
