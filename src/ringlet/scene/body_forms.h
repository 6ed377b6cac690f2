// What there is to know of bodies: of each shape its name, how far it reaches, how far a place is from it; of
// each number its name, range and the shapes that have it. Scene files, checks, packing, measures, C and
// Python read it here.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ringlet/scene/body.h"
#include "ringlet/scene/setting_field.h"

namespace ringlet {

struct BodyForm {
  BodyShape shape;
  std::string_view name;  // in scene files and messages
  DeviceForm onDevice;

  /// As the device's form takes it: half extents, and how far further out its surface is [m].
  Vec3d (*halfExtents)(const Body&);
  double (*rounding)(const Body&);

  /// Of the ball about its middle that holds it [m]; infinite for a plane.
  double (*reach)(const Body&);

  /// Of a place in its own frame from its surface, thickness apart [m]; negative inside. Null for a grid.
  double (*distance)(const Body&, Vec3d);
};

/// In the order of BodyShape.
std::span<const BodyForm> bodyForms();
const BodyForm& formOf(BodyShape shape);
inline std::string_view nameOf(BodyShape shape) { return formOf(shape).name; }

/// Null for an unknown name.
const BodyForm* formNamed(std::string_view name);

/// The names of all shapes, with ", " between.
std::string shapeNames();

/// Its numbers, but for the place; `onlyWith` has the names of the shapes that have it.
std::span<const SettingField<Body>> bodyNumbers();

/// Whether bodies of this shape have the number.
bool hasNumber(const BodyForm& form, const SettingField<Body>& number);

/// Those that they have.
std::vector<SettingField<Body>> bodyNumbersOf(const BodyForm& form);

}  // namespace ringlet
