// DensityGrid: density of particles at a place, with trilinear weights on a grid of cells. For densities at
// rest; those of a step are computed on the device (shaders/kernels/volume_gather.comp).
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "ringlet/base/vec3.h"
#include "ringlet/rest/cell_map.h"

namespace ringlet {

class DensityGrid {
 public:
  /// cell: [m], more than 0.
  explicit DensityGrid(double cell) : cell_(cell) {}

  /// Key of the cell of a place. Places farther than a million cells from the origin share keys.
  static std::uint64_t cellOf(Vec3f place, double cell) {
    const auto part = [&](float x) {
      return static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(x / cell))) & kMask;
    };
    return part(place.x) | part(place.y) << 21 | part(place.z) << 42;
  }

  /// Adds a mass [kg] at a place [m].
  void add(Vec3f place, double mass) {
    eachNode(place, [&](std::uint64_t node, double weight) { nodes_.at(node, 0) += weight * mass; });
  }
  /// Density at a place [kg/m^3].
  double at(Vec3f place) const {
    double sum = 0;
    eachNode(place, [&](std::uint64_t node, double weight) {
      if (const double* mass = nodes_.find(node)) sum += weight * *mass;
    });
    return sum / (cell_ * cell_ * cell_);
  }
  /// Removes all masses and keeps the memory.
  void clear() { nodes_.clear(); }

 private:
  static constexpr std::uint64_t kMask = (std::uint64_t{1} << 21) - 1;

  template <class Tell>
  void eachNode(Vec3f place, Tell&& tell) const {
    const std::array<double, 3> x{place.x / cell_, place.y / cell_, place.z / cell_};
    std::array<double, 3> share{};
    std::array<std::uint64_t, 3> low{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double cell = std::floor(x[axis]);
      low[axis] = static_cast<std::uint64_t>(static_cast<std::int64_t>(cell));
      share[axis] = x[axis] - cell;
    }
    for (unsigned corner = 0; corner < 8; ++corner) {
      std::uint64_t node = 0;
      double weight = 1;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const unsigned far = corner >> axis & 1;
        node |= ((low[axis] + far) & kMask) << 21 * axis;
        weight *= far ? share[axis] : 1 - share[axis];
      }
      tell(node, weight);
    }
  }

  double cell_;
  CellMap<double> nodes_;  // mass at each node [kg]
};

}  // namespace ringlet
