// Implements base/nearest_points.h.
#include "ringlet/base/nearest_points.h"

#include <algorithm>
#include <cmath>

#include "ringlet/base/bounds.h"

namespace ringlet {
namespace {

double coordinate(Vec3d p, int axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }

// Keeps the nearest, in order.
void keep(NearestPoints::Near near, std::size_t count, std::vector<NearestPoints::Near>& found) {
  if (found.size() == count) {
    if (!(near.distance < found.back().distance)) return;
    found.pop_back();
  }
  const auto behind =
      std::ranges::upper_bound(found, near.distance, {}, [](const auto& other) { return other.distance; });
  found.insert(behind, near);
}

}  // namespace

NearestPoints::NearestPoints(std::span<const Vec3d> points) : axes_(points.size()) {
  for (std::size_t i = 0; i < points.size(); ++i)
    entries_.push_back({points[i], static_cast<std::uint32_t>(i)});
  divide(0, entries_.size());
}

void NearestPoints::find(Vec3d place, std::size_t count, std::vector<Near>& found) const {
  found.clear();
  if (count > 0) search(0, entries_.size(), place, count, found);
}

void NearestPoints::divide(std::size_t begin, std::size_t end) {
  if (end - begin < 2) return;
  const int axis = widestAxis(begin, end);
  const std::size_t middle = begin + (end - begin) / 2;
  const auto at = [&](std::size_t i) { return entries_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(begin), at(middle), at(end), [axis](const Entry& a, const Entry& b) {
    return coordinate(a.at, axis) < coordinate(b.at, axis);
  });
  axes_[middle] = axis;
  divide(begin, middle);
  divide(middle + 1, end);
}

int NearestPoints::widestAxis(std::size_t begin, std::size_t end) const {
  Bounds bounds = Bounds::none();
  for (std::size_t i = begin; i < end; ++i) bounds.add(entries_[i].at);
  const Vec3d size = bounds.high - bounds.low;
  if (size.x >= size.y && size.x >= size.z) return 0;
  return size.y >= size.z ? 1 : 2;
}

void NearestPoints::search(std::size_t begin, std::size_t end, Vec3d place, std::size_t count,
                           std::vector<Near>& found) const {
  if (begin == end) return;
  const std::size_t middle = begin + (end - begin) / 2;
  const Entry& entry = entries_[middle];
  keep({length(place - entry.at), entry.point}, count, found);
  const double across = coordinate(place, axes_[middle]) - coordinate(entry.at, axes_[middle]);
  const bool below = across < 0;
  below ? search(begin, middle, place, count, found) : search(middle + 1, end, place, count, found);
  // All points beyond the split are farther away.
  if (found.size() == count && std::abs(across) >= found.back().distance) return;
  below ? search(middle + 1, end, place, count, found) : search(begin, middle, place, count, found);
}

}  // namespace ringlet
