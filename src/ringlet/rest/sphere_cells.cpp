// Implements rest/sphere_cells.h.
#include "ringlet/rest/sphere_cells.h"

namespace ringlet {

SphereCells::SphereCells(std::span<const Sphere> spheres, Vec3d low, double cellSize) {
  struct Place {
    Cell cell;
    std::uint32_t sphere;
    auto operator<=>(const Place&) const = default;
  };
  std::vector<Place> places;
  places.reserve(spheres.size());
  for (const Sphere& sphere : spheres) {
    const Vec3d above = (static_cast<Vec3d>(sphere.centre) - low) / cellSize;
    places.push_back({{static_cast<std::int32_t>(above.x), static_cast<std::int32_t>(above.y),
                       static_cast<std::int32_t>(above.z)},
                      static_cast<std::uint32_t>(places.size())});
  }
  std::ranges::sort(places);
  spheres_.reserve(spheres.size());
  for (const Place& place : places) {
    if (cells_.empty() || cells_.back() != place.cell) {
      cells_.push_back(place.cell);
      first_.push_back(static_cast<std::uint32_t>(spheres_.size()));
    }
    spheres_.push_back(spheres[place.sphere]);
  }
  first_.push_back(static_cast<std::uint32_t>(spheres_.size()));
}

}  // namespace ringlet
