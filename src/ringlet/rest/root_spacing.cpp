// Implements rest/root_spacing.h with a k-d tree (Bentley 1975) stored in the sorted points themselves: a
// range's middle point splits it; points left of it are below it on the range's axis.
#include "ringlet/rest/root_spacing.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <numeric>
#include <vector>

namespace ringlet {
namespace {

double coordinate(Vec3d p, int axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }

class NearestPoints {
 public:
  explicit NearestPoints(std::span<const Vec3d> points)
      : points_(points.begin(), points.end()), axes_(points.size()) {
    divide(0, points_.size());
  }

  // Distance from the tree's i-th point to the nearest other one.
  double distanceToNearest(std::size_t i) const {
    double best = std::numeric_limits<double>::infinity();
    search(0, points_.size(), i, best);
    return best;
  }

 private:
  void divide(std::size_t begin, std::size_t end) {
    if (end - begin < 2) return;
    const int axis = widestAxis(begin, end);
    const std::size_t middle = begin + (end - begin) / 2;
    const auto at = [&](std::size_t i) { return points_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(begin), at(middle), at(end),
                     [axis](Vec3d a, Vec3d b) { return coordinate(a, axis) < coordinate(b, axis); });
    axes_[middle] = axis;
    divide(begin, middle);
    divide(middle + 1, end);
  }

  int widestAxis(std::size_t begin, std::size_t end) const {
    int widest = 0;
    double widestExtent = -1;
    for (int axis = 0; axis < 3; ++axis) {
      double low = coordinate(points_[begin], axis), high = low;
      for (std::size_t i = begin; i < end; ++i) {
        low = std::min(low, coordinate(points_[i], axis));
        high = std::max(high, coordinate(points_[i], axis));
      }
      if (high - low > widestExtent) widest = axis, widestExtent = high - low;
    }
    return widest;
  }

  void search(std::size_t begin, std::size_t end, std::size_t self, double& best) const {
    if (begin == end) return;
    const std::size_t middle = begin + (end - begin) / 2;
    if (middle != self) best = std::min(best, length(points_[self] - points_[middle]));
    const double across =
        coordinate(points_[self], axes_[middle]) - coordinate(points_[middle], axes_[middle]);
    const bool below = across < 0;
    below ? search(begin, middle, self, best) : search(middle + 1, end, self, best);
    if (std::abs(across) >= best) return;  // all points beyond the split are farther away
    below ? search(middle + 1, end, self, best) : search(begin, middle, self, best);
  }

  std::vector<Vec3d> points_;
  std::vector<int> axes_;  // that each middle point splits
};

}  // namespace

double meanNearestDistance(std::span<const Vec3d> points) {
  if (points.size() < 2) return 0;
  const NearestPoints nearest(points);
  std::vector<double> distances;
  for (std::size_t i = 0; i < points.size(); ++i) distances.push_back(nearest.distanceToNearest(i));
  std::sort(distances.begin(), distances.end());  // makes the sum independent of the order of the points
  return std::accumulate(distances.begin(), distances.end(), 0.0) / static_cast<double>(points.size());
}

}  // namespace ringlet
