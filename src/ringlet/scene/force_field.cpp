// Implements scene/force_field.h.
#include "ringlet/scene/force_field.h"

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <variant>

#include "ringlet/scene/outside_numbers.h"
#include "ringlet/scene/setting_check.h"

namespace ringlet {

namespace {

constexpr NumberRange kStrength{-1e6, 1e6}, kLength{0, 1000}, kAxis{-1e30, 1e30};

}  // namespace

std::span<const SettingField<ForceField>> forceFieldNumbers() {
  using F = ForceField;
  static const SettingField<F> all[] = {
      {"axis", "", "", "Direction of its axis in the place's axes, of any length above 0.", &F::axis, kAxis},
      {"about_axis", "", "", "Whether distances are from the axis and not from the place.", &F::aboutAxis},
      {"axial", "m/s^2", "", "Strength along the axis; with drag m/s, as all strengths.", &F::axial,
       kStrength},
      {"radial", "m/s^2", "", "Strength away from the place, or from the axis.", &F::radial, kStrength},
      {"around", "m/s^2", "", "Strength about the axis, right-handed.", &F::around, kStrength},
      {"core", "m", "", "Distance below which radial and around fade to 0.", &F::core, kLength},
      {"reach", "m", "", "Distance at which the field has faded to nothing; 0: nowhere.", &F::reach, kLength},
      {"drag", "1/s", "", "How fast the field's air takes hair along.", &F::drag, {0, 1e6}},
      {"front", "m", "", "Distance of a shell, outside of which the field is 0.", &F::front, {-1e6, 1e6}},
      {"thickness", "m", "", "Half of the shell's; 0: there is no shell.", &F::thickness, kLength},
      {"grid_share", "1", "", "Factor on the grid's velocities.", &F::gridShare, kStrength},
  };
  return all;
}

Status checkForceField(const ForceField& field) {
  const auto wrong = [&](const char* what, double value, const char* range) {
    return Error{fmt::format("the field {}: found the {} {}; expected {}", field.name, what, value, range)};
  };
  const std::string owner = fmt::format("the field {}: ", field.name);
  if (Status checked = checkRows(forceFieldNumbers(), field, owner); !checked) return checked;
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
  for (const SettingField<ForceField>& number : forceFieldNumbers())
    if (const auto* member = std::get_if<double ForceField::*>(&number.member))
      now.** member = a.**member + s * (b.**member - a.**member);
  return now;
}

Vec3d worldAxis(const ForceField& field) {
  return rotate(field.place.rotation, field.axis / length(field.axis));
}

}  // namespace ringlet
