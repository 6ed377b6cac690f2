// Implements scene/force_field.h.
#include "ringlet/scene/force_field.h"

#include <fmt/format.h>

#include <cmath>

#include "ringlet/scene/outside_numbers.h"

namespace ringlet {

Status checkForceField(const ForceField& field) {
  const auto wrong = [&](const char* what, double value, const char* range) {
    return Error{fmt::format("the field {}: found the {} {}; expected {}", field.name, what, value, range)};
  };
  const struct {
    const char* name;
    double value, low, high;
    const char* range;
  } numbers[] = {
      {"axial strength", field.axial, -1e6, 1e6, "a number from -1e6 to 1e6"},
      {"radial strength", field.radial, -1e6, 1e6, "a number from -1e6 to 1e6"},
      {"strength about the axis", field.around, -1e6, 1e6, "a number from -1e6 to 1e6"},
      {"factor on the grid", field.gridShare, -1e6, 1e6, "a number from -1e6 to 1e6"},
      {"core", field.core, 0, 1000, "a length from 0 to 1000 m"},
      {"reach", field.reach, 0, 1000, "a length from 0 to 1000 m"},
      {"drag", field.drag, 0, 1e6, "a rate from 0 to 1e6 1/s"},
      {"front", field.front, -1e6, 1e6, "a distance from -1e6 to 1e6 m"},
      {"thickness", field.thickness, 0, 1000, "a length from 0 to 1000 m"},
  };
  for (const auto& number : numbers) {
    if (!(number.value >= number.low && number.value <= number.high))
      return wrong(number.name, number.value, number.range);
  }
  if (!(length(field.axis) > 1e-9 && std::isfinite(length(field.axis))))
    return wrong("length of the axis", length(field.axis), "more than 0");
  if (!contains(kPosePlace, field.place.position))
    return wrong("distance of the place", length(field.place.position), "at most 1e9 m along each axis");
  if (!field.grid) return {};
  const VelocityGrid& grid = *field.grid;
  std::size_t count = 1;
  for (const std::uint32_t nodes : grid.nodes) {
    if (nodes < 2) return wrong("grid's number of nodes on a side", nodes, "2 or more");
    count *= nodes;
  }
  if (count != grid.velocities.size())
    return wrong("grid's number of velocities", static_cast<double>(grid.velocities.size()),
                 "as many as it has nodes");
  if (Status checked = checkEach(grid.velocities, "velocity", kOutsideSpeed, "m/s"); !checked)
    return Error{fmt::format("the field {}, of its grid's nodes as particles: {}", field.name,
                             checked.error().message)};
  if (!(grid.cell > 0 && grid.cell <= 1000)) return wrong("grid's cell", grid.cell, "above 0, to 1000 m");
  return {};
}

ForceField interpolate(const ForceField& a, const ForceField& b, double s) {
  ForceField now = b;
  now.place = interpolate(a.place, b.place, s);
  for (double ForceField::*number :
       {&ForceField::axial, &ForceField::radial, &ForceField::around, &ForceField::core, &ForceField::reach,
        &ForceField::drag, &ForceField::front, &ForceField::thickness, &ForceField::gridShare})
    now.*number = a.*number + s * (b.*number - a.*number);
  return now;
}

Vec3d worldAxis(const ForceField& field) {
  return rotate(field.place.rotation, field.axis / length(field.axis));
}

}  // namespace ringlet
