// Implements groom/sample_elimination.h.
#include "ringlet/groom/sample_elimination.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <set>
#include <utility>

namespace ringlet {
namespace {

// Which samples are in each cubic cell.
class Cells {
 public:
  Cells(std::span<const Vec3d> points, double edge) : edge_(edge) {
    for (std::size_t i = 0; i < points.size(); ++i)
      cells_[cellOf(points[i])].push_back(static_cast<std::uint32_t>(i));
  }

  /// Of all within an edge of the place, and others.
  template <class Tell>
  void eachNear(Vec3d place, const Tell& tell) const {
    const auto [x, y, z] = cellOf(place);
    for (int k = 0; k < 27; ++k) {
      const auto cell = cells_.find({x + k % 3 - 1, y + k / 3 % 3 - 1, z + k / 9 - 1});
      if (cell == cells_.end()) continue;
      for (const std::uint32_t i : cell->second) tell(i);
    }
  }

 private:
  using Cell = std::array<long, 3>;
  Cell cellOf(Vec3d p) const {
    return {std::lround(std::floor(p.x / edge_)), std::lround(std::floor(p.y / edge_)),
            std::lround(std::floor(p.z / edge_))};
  }

  double edge_;
  std::map<Cell, std::vector<std::uint32_t>> cells_;
};

}  // namespace

std::vector<std::uint32_t> eliminateSamples(std::span<const Vec3d> points, std::size_t count, double area) {
  std::vector<std::uint32_t> kept(points.size());
  std::iota(kept.begin(), kept.end(), 0u);
  if (points.size() <= count) return kept;
  if (count == 0) return {};

  // Twice the radius of discs in a hexagonal packing.
  const double reach = 2 * std::sqrt(area / (2 * std::numbers::sqrt3 * static_cast<double>(count)));
  const auto weigh = [&](std::uint32_t i, std::uint32_t j) {
    return std::pow(std::max(0.0, 1 - length(points[i] - points[j]) / reach), 8);
  };
  const Cells cells(points, reach);
  std::vector<double> weights(points.size());
  for (const std::uint32_t i : kept)
    cells.eachNear(points[i], [&](std::uint32_t j) { weights[i] += j == i ? 0 : weigh(i, j); });

  using Entry = std::pair<double, std::uint32_t>;  // by falling weight
  std::set<Entry> left;
  for (const std::uint32_t i : kept) left.emplace(-weights[i], i);
  while (left.size() > count) {
    const std::uint32_t gone = left.begin()->second;
    left.erase(left.begin());
    cells.eachNear(points[gone], [&](std::uint32_t j) {
      const auto entry = left.find({-weights[j], j});
      const double weight = j == gone ? 0 : weigh(gone, j);
      if (entry == left.end() || weight == 0) return;
      left.erase(entry);
      weights[j] -= weight;
      left.emplace(-weights[j], j);
    });
  }
  kept.clear();
  for (const auto& [weight, i] : left) kept.push_back(i);
  std::ranges::sort(kept);
  return kept;
}

}  // namespace ringlet
