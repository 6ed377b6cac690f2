// Implements bodies/near_triangles.h.
#include "ringlet/bodies/near_triangles.h"

#include <algorithm>
#include <cmath>

#include "ringlet/bodies/distance_to_triangle.h"

namespace ringlet {
namespace {

constexpr double kMostCells = 1 << 18;  // a box of cells takes a millisecond then

// Triangles are listed in cells a little further away than promised, whatever rounding does to either.
constexpr double kRounding = 1e-3;  // of the reach

// A place of a triangle's plane this near to the triangle may be in it [edges of a cell].
constexpr double kInTriangle = 1e-6;

// Needles are lower than this share of their length.
constexpr double kNeedle = 1e-6;

Vec3d normalOf(const std::array<Vec3d, 3>& corners) {
  const Vec3d ab = corners[1] - corners[0], ac = corners[2] - corners[0], across = cross(ab, ac);
  const double area = length(across);
  return area > kNeedle * length(ab) * length(ac) ? across / area : Vec3d{};
}

double largestSide(Vec3d size) { return std::max({size.x, size.y, size.z}); }

}  // namespace

NearTriangles::NearTriangles(const TriangleMesh& mesh, double leastReach) {
  triangles_.reserve(mesh.triangles.size());
  for (const auto& t : mesh.triangles) {
    const std::array<Vec3d, 3> corners{mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]};
    triangles_.push_back({corners, normalOf(corners)});
  }
  chooseCells(mesh, leastReach);
  list();
  findOutside();
}

// About as long as triangles, so that a triangle is in few cells and a cell has few of them.
void NearTriangles::chooseCells(const TriangleMesh& mesh, double leastReach) {
  double sides = 0;
  for (const Triangle& triangle : triangles_) {
    Bounds bounds = Bounds::none();
    for (const Vec3d corner : triangle.corners) bounds.add(corner);
    sides += largestSide(bounds.high - bounds.low);
  }
  const Bounds box = boundsOf(mesh);
  const Vec3d size = box.high - box.low;
  edge_ = std::max({sides / static_cast<double>(triangles_.size()), leastReach, 1e-6,
                    largestSide(size) / std::cbrt(kMostCells)});
  reach_ = std::max(leastReach, edge_ / 2);
  listingReach_ = reach_ * (1 + kRounding);
  const double around = listingReach_ + edge_;  // the outermost cells list nothing
  low_ = box.low - Vec3d{around, around, around};
  for (int axis = 0; axis < 3; ++axis) {
    const double side = (axis == 0 ? size.x : axis == 1 ? size.y : size.z) + 2 * around;
    counts_[static_cast<std::size_t>(axis)] = static_cast<int>(std::ceil(side / edge_)) + 1;
  }
  const auto [x, y, z] = counts_;
  cells_.assign(static_cast<std::size_t>(x) * static_cast<std::size_t>(y) * static_cast<std::size_t>(z),
                Cell::enclosed);
}

std::size_t NearTriangles::cellAt(Vec3d place) const {
  const Vec3d at = (place - low_) / edge_;
  if (!(at.x >= 0 && at.y >= 0 && at.z >= 0 && at.x < counts_[0] && at.y < counts_[1] && at.z < counts_[2]))
    return kNoCell;
  const auto x = static_cast<std::size_t>(at.x), y = static_cast<std::size_t>(at.y),
             z = static_cast<std::size_t>(at.z);
  return x + static_cast<std::size_t>(counts_[0]) * (y + static_cast<std::size_t>(counts_[1]) * z);
}

NearTriangles::Range NearTriangles::rangeOf(const Triangle& triangle) const {
  Bounds bounds = Bounds::none();
  for (const Vec3d corner : triangle.corners) bounds.add(corner - low_);
  const auto cellOf = [&](double way, double further) { return static_cast<int>((way + further) / edge_); };
  return {{cellOf(bounds.low.x, -listingReach_), cellOf(bounds.low.y, -listingReach_),
           cellOf(bounds.low.z, -listingReach_)},
          {cellOf(bounds.high.x, listingReach_), cellOf(bounds.high.y, listingReach_),
           cellOf(bounds.high.z, listingReach_)}};
}

// Visits the cells that are within listingReach_ of both the triangle's box and its plane.
template <class Visit>
void NearTriangles::forCellsNear(const Triangle& triangle, const Visit& visit) const {
  const Range range = rangeOf(triangle);
  const Vec3d n = triangle.normal;
  const double most = listingReach_ + (std::abs(n.x) + std::abs(n.y) + std::abs(n.z)) * edge_ / 2;
  const double height = dot(n, triangle.corners[0] - low_) / edge_;
  for (int z = range.first[2]; z <= range.last[2]; ++z) {
    for (int y = range.first[1]; y <= range.last[1]; ++y) {
      const double above = n.y * (y + 0.5) + n.z * (z + 0.5) - height;
      const std::size_t row =
          static_cast<std::size_t>(counts_[0]) *
          (static_cast<std::size_t>(y) + static_cast<std::size_t>(counts_[1]) * static_cast<std::size_t>(z));
      for (int x = range.first[0]; x <= range.last[0]; ++x) {
        if (std::abs(above + n.x * (x + 0.5)) * edge_ <= most) visit(row + static_cast<std::size_t>(x));
      }
    }
  }
}

void NearTriangles::list() {
  first_.assign(cells_.size() + 1, 0);
  for (const Triangle& triangle : triangles_)
    forCellsNear(triangle, [&](std::size_t cell) { ++first_[cell + 1]; });
  for (std::size_t cell = 0; cell < cells_.size(); ++cell) {
    if (first_[cell + 1] > 0) cells_[cell] = Cell::near;
    first_[cell + 1] += first_[cell];
  }
  listed_.resize(first_.back());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    forCellsNear(triangles_[t],
                 [&](std::size_t cell) { listed_[next[cell]++] = static_cast<std::uint32_t>(t); });
  }
}

// From a corner of the box on through all cells that list nothing. All its outermost cells are such.
void NearTriangles::findOutside() {
  const std::array<std::size_t, 3> strides{
      1, static_cast<std::size_t>(counts_[0]),
      static_cast<std::size_t>(counts_[0]) * static_cast<std::size_t>(counts_[1])};
  std::vector<std::size_t> open{0};
  cells_[0] = Cell::outside;
  const auto reachCell = [&](std::size_t cell) {
    if (cells_[cell] != Cell::enclosed) return;
    cells_[cell] = Cell::outside;
    open.push_back(cell);
  };
  while (!open.empty()) {
    const std::size_t cell = open.back();
    open.pop_back();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t count = static_cast<std::size_t>(counts_[axis]), stride = strides[axis];
      const std::size_t at = cell / stride % count;
      if (at > 0) reachCell(cell - stride);
      if (at + 1 < count) reachCell(cell + stride);
    }
  }
}

double NearTriangles::distanceTo(Vec3d place, std::size_t cell) const {
  const double farthest = reach_ * reach_;
  double least = farthest;
  for (std::uint32_t i = first_[cell]; i < first_[cell + 1]; ++i) {
    const Triangle& triangle = triangles_[listed_[i]];
    const double above = dot(triangle.normal, place - triangle.corners[0]);
    // Rounding may lift a place off the plane of a triangle that it is as near to as to another.
    if (above * above * (1 - kRounding) > least) continue;
    const auto& [a, b, c] = triangle.corners;
    const Vec3d apart = place - closestOnTriangle(place, a, b, c);
    least = std::min(least, dot(apart, apart));
  }
  return least < farthest ? std::sqrt(least) : reach_;
}

bool NearTriangles::isFreeBetween(Vec3d place, Vec3d other, std::size_t cell) const {
  const double near = kInTriangle * edge_;
  for (std::uint32_t i = first_[cell]; i < first_[cell + 1]; ++i) {
    const Triangle& triangle = triangles_[listed_[i]];
    const auto& [a, b, c] = triangle.corners;
    const double above = dot(triangle.normal, place - a), otherAbove = dot(triangle.normal, other - a);
    if (std::min(above, otherAbove) > near || std::max(above, otherAbove) < -near) continue;
    if (std::abs(above - otherAbove) < 2 * near) return false;  // along the plane
    const double share = std::clamp(above / (above - otherAbove), 0.0, 1.0);
    const Vec3d through = place + (other - place) * share;
    const Vec3d apart = through - closestOnTriangle(through, a, b, c);
    if (dot(apart, apart) < 16 * near * near) return false;
  }
  return true;
}

}  // namespace ringlet
