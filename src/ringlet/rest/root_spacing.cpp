// Implements rest/root_spacing.h.
#include "ringlet/rest/root_spacing.h"

#include <algorithm>
#include <numeric>
#include <vector>

#include "ringlet/base/nearest_points.h"

namespace ringlet {

double meanNearestDistance(std::span<const Vec3d> points) {
  if (points.size() < 2) return 0;
  const NearestPoints tree(points);
  std::vector<NearestPoints::Near> found;
  std::vector<double> distances;
  for (const Vec3d& point : points) {
    tree.find(point, 2, found);  // the point itself, or one in its place, and the nearest other
    distances.push_back(found.back().distance);
  }
  std::sort(distances.begin(), distances.end());  // makes the sum independent of the order of the points
  return std::accumulate(distances.begin(), distances.end(), 0.0) / static_cast<double>(points.size());
}

}  // namespace ringlet
