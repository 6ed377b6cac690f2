// Implements groom/sample_elimination.h.
#include "ringlet/groom/sample_elimination.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>
#include <queue>
#include <unordered_map>
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
  struct Hash {
    std::size_t operator()(const Cell& cell) const {
      std::size_t hash = 0;
      for (const long number : cell)
        hash = (hash ^ static_cast<std::size_t>(number)) * 0x9e3779b97f4a7c15u;  // 2^64 over the golden ratio
      return hash ^ (hash >> 32);
    }
  };
  Cell cellOf(Vec3d p) const {
    return {std::lround(std::floor(p.x / edge_)), std::lround(std::floor(p.y / edge_)),
            std::lround(std::floor(p.z / edge_))};
  }

  double edge_;
  std::unordered_map<Cell, std::vector<std::uint32_t>, Hash> cells_;
};

// What each sample adds to the weights of those near it.
struct Shares {
  std::vector<std::size_t> first{0};  // of each sample, and one more
  std::vector<std::uint32_t> other;
  std::vector<double> weight;

  Shares(std::span<const Vec3d> points, double reach) {
    const Cells cells(points, reach);
    for (std::size_t i = 0; i < points.size(); ++i) {
      cells.eachNear(points[i], [&](std::uint32_t j) {
        const double near = 1 - length(points[i] - points[j]) / reach;
        if (j == i || !(near > 0)) return;
        other.push_back(j);
        weight.push_back(std::pow(near, 8));
      });
      first.push_back(other.size());
    }
  }
};

}  // namespace

std::vector<std::uint32_t> eliminateSamples(std::span<const Vec3d> points, std::size_t count, double area) {
  std::vector<std::uint32_t> kept(points.size());
  std::iota(kept.begin(), kept.end(), 0u);
  if (points.size() <= count) return kept;
  if (count == 0) return {};

  // Twice the radius of discs in a hexagonal packing.
  const double reach = 2 * std::sqrt(area / (2 * std::numbers::sqrt3 * static_cast<double>(count)));
  const Shares shares(points, reach);
  std::vector<double> weights(points.size());
  using Entry = std::pair<double, std::int64_t>;  // a weight, and the sample with its sign changed
  std::priority_queue<Entry> heaviest;
  for (const std::uint32_t i : kept) {
    for (std::size_t k = shares.first[i]; k < shares.first[i + 1]; ++k) weights[i] += shares.weight[k];
    heaviest.emplace(weights[i], -std::int64_t{i});
  }
  std::vector<bool> isGone(points.size());
  for (std::size_t left = points.size(); left > count;) {
    const auto [weight, sample] = heaviest.top();
    heaviest.pop();
    const auto gone = static_cast<std::uint32_t>(-sample);
    if (weight != weights[gone]) {  // it has become lighter since
      heaviest.emplace(weights[gone], sample);
      continue;
    }
    isGone[gone] = true;
    --left;
    for (std::size_t k = shares.first[gone]; k < shares.first[gone + 1]; ++k)
      if (!isGone[shares.other[k]]) weights[shares.other[k]] -= shares.weight[k];
  }
  std::erase_if(kept, [&](std::uint32_t i) { return isGone[i]; });
  return kept;
}

}  // namespace ringlet
