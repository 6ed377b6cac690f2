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

// The grid of a DistanceGrid or a BendingMesh.
void setGrid(layout::BodyRest& rest, const auto& grid, std::uint32_t firstPair) {
  rest.gridOrigin = packed3(grid.origin);
  rest.cell = static_cast<float>(grid.cell);
  std::copy(grid.counts.begin(), grid.counts.end(), rest.cells);
  rest.firstPair = firstPair;
}

Vec3d middleOf(const auto& grid) {
  const Vec3d size =
      Vec3d{double(grid.counts[0]), double(grid.counts[1]), double(grid.counts[2])} * grid.cell;
  return grid.origin + size * 0.5;
}

layout::BodyRest restOf(const Body& body, std::uint32_t firstPair) {
  const BodyForm& form = formOf(body.shape);
  const double reach = form.reach(body);
  layout::BodyRest rest{};
  rest.friction = static_cast<float>(body.friction);
  rest.shape = static_cast<std::uint32_t>(form.onDevice);
  rest.halfExtents = packed3(form.halfExtents(body));
  rest.rounding = static_cast<float>(form.rounding(body) + body.thickness);
  const double radius = std::isfinite(reach) ? reach + body.thickness : kEndless;
  if (body.bends()) {
    rest.shape = body.isCloth() ? layout::kShapeCloth : layout::kShapeField;
    rest.bounds = packed(middleOf(*body.mesh), radius);
    setGrid(rest, *body.mesh, firstPair);
  } else if (body.shape == BodyShape::grid) {
    rest.bounds = packed(middleOf(*body.grid), radius);
    setGrid(rest, *body.grid, firstPair);
  } else {
    rest.bounds = packed(Vec3d{}, radius);
  }
  return rest;
}

// Adds a pair for each corner, as gridDistance reads them (shaders/equations/body_distance.glsl). The last
// corner of a row, which has no neighbour, is never the first of a pair that is read.
void addPairs(const DistanceGrid& grid, std::vector<std::uint32_t>& pairs) {
  const float cell = static_cast<float>(grid.cell);
  const std::size_t first = pairs.size();
  for (const float distance : grid.distances) pairs.push_back(halfBits(distance / cell));
  for (std::size_t k = first; k + 1 < pairs.size(); ++k) pairs[k] |= pairs[k + 1] << 16;
}

}  // namespace

PackedBodies packBodies(std::span<const Body> bodies) {
  PackedBodies packed;
  for (const Body& body : bodies) {
    packed.rests.push_back(restOf(body, static_cast<std::uint32_t>(packed.pairs.size())));
    if (body.shape == BodyShape::grid && !body.bends()) addPairs(*body.grid, packed.pairs);
  }
  return packed;
}

}  // namespace ringlet
