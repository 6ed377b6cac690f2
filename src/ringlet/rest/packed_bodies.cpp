// Implements rest/packed_bodies.h.
#include "ringlet/rest/packed_bodies.h"

#include <algorithm>
#include <cmath>

#include "ringlet/base/half.h"
#include "ringlet/base/packed.h"
#include "ringlet/scene/body_forms.h"

namespace ringlet {
namespace {

constexpr double kEndless = 1e15;  // bounds of a plane [m]; its square is a finite float

static_assert(std::uint32_t(DeviceForm::box) == layout::kShapeBox &&
              std::uint32_t(DeviceForm::plane) == layout::kShapePlane &&
              std::uint32_t(DeviceForm::grid) == layout::kShapeGrid);

void setGrid(layout::BodyRest& rest, const DistanceGrid& grid, std::uint32_t firstCell) {
  rest.gridOrigin = packed3(grid.origin);
  rest.cell = static_cast<float>(grid.cell);
  std::copy(grid.counts.begin(), grid.counts.end(), rest.cells);
  rest.firstCell = firstCell;
}

Vec3d middleOf(const DistanceGrid& grid) {
  const Vec3d size =
      Vec3d{double(grid.counts[0]), double(grid.counts[1]), double(grid.counts[2])} * grid.cell;
  return grid.origin + size * 0.5;
}

layout::BodyRest restOf(const Body& body, std::uint32_t firstCell) {
  const BodyForm& form = formOf(body.shape);
  const double reach = form.reach(body);
  layout::BodyRest rest{};
  rest.friction = static_cast<float>(body.friction);
  rest.shape = static_cast<std::uint32_t>(form.onDevice);
  rest.halfExtents = packed3(form.halfExtents(body));
  rest.rounding = static_cast<float>(form.rounding(body) + body.thickness);
  rest.bounds = packed(body.shape == BodyShape::grid ? middleOf(*body.grid) : Vec3d{},
                       std::isfinite(reach) ? reach + body.thickness : kEndless);
  if (body.shape == BodyShape::grid) setGrid(rest, *body.grid, firstCell);
  return rest;
}

// Adds the eight corners of each cell, in the layout that gridDistance reads
// (shaders/equations/body_distance.glsl).
void addCells(const DistanceGrid& grid, std::vector<layout::uvec4>& cells) {
  const float cell = static_cast<float>(grid.cell);
  const auto half = [&](std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    return std::uint32_t{halfBits(grid.distances[grid.cornerIndex(x, y, z)] / cell)};
  };
  for (std::uint32_t z = 0; z < grid.counts[2]; ++z)
    for (std::uint32_t y = 0; y < grid.counts[1]; ++y)
      for (std::uint32_t x = 0; x < grid.counts[0]; ++x) {
        const auto pair = [&](std::uint32_t dy, std::uint32_t dz) {
          return half(x, y + dy, z + dz) | half(x + 1, y + dy, z + dz) << 16;
        };
        cells.push_back({pair(0, 0), pair(1, 0), pair(0, 1), pair(1, 1)});
      }
}

}  // namespace

PackedBodies packBodies(std::span<const Body> bodies) {
  PackedBodies packed;
  for (const Body& body : bodies) {
    packed.rests.push_back(restOf(body, static_cast<std::uint32_t>(packed.cells.size())));
    if (body.shape == BodyShape::grid) addCells(*body.grid, packed.cells);
  }
  return packed;
}

}  // namespace ringlet
