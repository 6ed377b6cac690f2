// What there is to know of each shape of a body: its name, which sizes it has, how far it reaches, how far a
// place is from it. Scene files, checks, packing and measures read it here.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "ringlet/scene/body.h"

namespace ringlet {

struct BodyForm {
  BodyShape shape;
  std::string_view name;  // in scene files and messages
  DeviceForm onDevice;
  bool hasRadius, hasLength, hasHalfExtents;

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

/// The names of the shapes that have this size, or of all where it is null, with ", " between.
std::string shapesWith(bool BodyForm::*size);

}  // namespace ringlet
