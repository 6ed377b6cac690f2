// ForceField: what acts on hair at places in the world: accelerations, air that moves, air that only brakes.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/base/vec3.h"
#include "ringlet/scene/body.h"
#include "ringlet/scene/setting_field.h"

namespace ringlet {

/// Velocities of air on a grid, evenly spaced; x is the fastest index.
struct VelocityGrid {
  std::array<std::uint32_t, 3> nodes{};  // along x, y, z; each at least 2
  double cell = 0.1;                     // distance between neighbours [m]
  std::vector<Vec3f> velocities;         // of each node [m/s]
};

/// Strengths are accelerations [m/s^2]; with drag they are velocities of the air [m/s]. The formula is in
/// reference/equations/force_field.h.
struct ForceField {
  std::string name{};      // for messages
  BodyPose place{};        // in the world; of a grid its node 0
  Vec3d axis{0, 1, 0};     // in the place's axes, of any length above 0
  bool aboutAxis = false;  // distances are from the axis and not from the place
  double axial = 0;        // along the axis
  double radial = 0;       // away from the place, or from the axis
  double around = 0;       // about the axis, right-handed
  double core = 0.02;      // distance below which radial and around fade to 0 [m], 0 to 1000
  double reach = 0;        // distance at which the field ends [m], 0 to 1000; 0: it does not
  double drag = 0;         // how fast the air takes hair along [1/s], 0 to 1e6; 0: no air, but accelerations
  double front = 0;        // distance of a shell, outside of which the field is 0 [m]
  double thickness = 0;    // half of the shell's [m], 0 to 1000; 0: there is no shell
  std::shared_ptr<const VelocityGrid> grid{};
  double gridShare = 1;  // factor on the grid's velocities

  bool operator==(const ForceField&) const = default;
};

/// More are refused.
inline constexpr std::size_t kMostForceFields = 64;

/// Its numbers, but for place and grid.
std::span<const SettingField<ForceField>> forceFieldNumbers();

/// Fails, with the field's name, on a number out of its range.
Status checkForceField(const ForceField& field);

/// At fraction s of the way from a to b: numbers evenly, the rotation by slerp; what has no way in between is
/// b's.
ForceField interpolate(const ForceField& a, const ForceField& b, double s);

/// Along world axes, of length 1.
Vec3d worldAxis(const ForceField& field);

}  // namespace ringlet
