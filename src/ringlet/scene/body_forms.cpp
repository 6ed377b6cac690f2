// Implements scene/body_forms.h.
#include "ringlet/scene/body_forms.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "ringlet/base/assert.h"

namespace ringlet {
namespace {

Vec3d noExtents(const Body&) { return {}; }
double radiusOf(const Body& body) { return body.radius; }
double noRounding(const Body&) { return 0; }

double distanceToCapsule(const Body& body, Vec3d y) {
  return length(y - Vec3d{0, std::clamp(y.y, -body.length / 2, body.length / 2), 0}) - body.radius;
}

double distanceToBox(const Body& body, Vec3d y) {
  const Vec3d half = body.halfExtents;
  const Vec3d beyond{std::abs(y.x) - half.x, std::abs(y.y) - half.y, std::abs(y.z) - half.z};
  const Vec3d outside{std::max(beyond.x, 0.0), std::max(beyond.y, 0.0), std::max(beyond.z, 0.0)};
  return length(outside) + std::min(std::max({beyond.x, beyond.y, beyond.z}), 0.0);
}

double reachOfGrid(const Body& body) {
  const auto& counts = body.bends() ? body.mesh->counts : body.grid->counts;
  const double cell = body.bends() ? body.mesh->cell : body.grid->cell;
  return length(Vec3d{double(counts[0]), double(counts[1]), double(counts[2])} * cell) / 2;
}

constexpr BodyForm kForms[] = {
    {.shape = BodyShape::sphere,
     .name = "sphere",
     .onDevice = DeviceForm::box,
     .halfExtents = noExtents,
     .rounding = radiusOf,
     .reach = radiusOf,
     .distance = [](const Body& body, Vec3d y) { return length(y) - body.radius; }},
    {.shape = BodyShape::capsule,
     .name = "capsule",
     .onDevice = DeviceForm::box,
     .halfExtents =
         [](const Body& body) {
           return Vec3d{0, body.length / 2, 0};
         },
     .rounding = radiusOf,
     .reach = [](const Body& body) { return body.length / 2 + body.radius; },
     .distance = distanceToCapsule},
    {.shape = BodyShape::plane,
     .name = "plane",
     .onDevice = DeviceForm::plane,
     .halfExtents = noExtents,
     .rounding = noRounding,
     .reach = [](const Body&) { return std::numeric_limits<double>::infinity(); },
     .distance = [](const Body&, Vec3d y) { return y.y; }},
    {.shape = BodyShape::box,
     .name = "box",
     .onDevice = DeviceForm::box,
     .halfExtents = [](const Body& body) { return body.halfExtents; },
     .rounding = noRounding,
     .reach = [](const Body& body) { return length(body.halfExtents); },
     .distance = distanceToBox},
    {.shape = BodyShape::grid,
     .name = "mesh",
     .onDevice = DeviceForm::grid,
     .halfExtents = noExtents,
     .rounding = noRounding,
     .reach = reachOfGrid,
     .distance = nullptr},
};

}  // namespace

std::span<const BodyForm> bodyForms() { return kForms; }

const BodyForm& formOf(BodyShape shape) {
  const auto form = std::ranges::find(kForms, shape, &BodyForm::shape);
  RINGLET_ASSERT(form != std::end(kForms), "a shape of a body without a form");
  return *form;
}

const BodyForm* formNamed(std::string_view name) {
  const auto form = std::ranges::find(kForms, name, &BodyForm::name);
  return form == std::end(kForms) ? nullptr : &*form;
}

std::string shapeNames() {
  std::string names;
  for (const BodyForm& form : kForms) names += (names.empty() ? "" : ", ") + std::string(form.name);
  return names;
}

std::span<const SettingField<Body>> bodyNumbers() {
  static const SettingField<Body> all[] = {
      {.key = "radius",
       .unit = "m",
       .standard = "",
       .effect = "Radius of a sphere or a capsule.",
       .member = &Body::radius,
       .allowed = {1e-6, 1000},
       .onlyWith = "sphere, capsule"},
      {.key = "length",
       .unit = "m",
       .standard = "",
       .effect = "Length of a capsule's axis, centred at the origin.",
       .member = &Body::length,
       .allowed = {0, 1000},
       .onlyWith = "capsule"},
      {.key = "half_extents",
       .unit = "m",
       .standard = "",
       .effect = "Half of the box's size, centred at the origin.",
       .member = &Body::halfExtents,
       .allowed = {1e-6, 1000},
       .onlyWith = "box"},
      {.key = "thickness",
       .unit = "m",
       .standard = "",
       .effect = "Distance that hair keeps from the surface.",
       .member = &Body::thickness,
       .allowed = {0, 1}},
      {.key = "friction",
       .unit = "1",
       .standard = "",
       .effect = "Coulomb's friction coefficient between hair and body.",
       .member = &Body::friction,
       .allowed = {0, 100}},
  };
  return all;
}

bool hasNumber(const BodyForm& form, const SettingField<Body>& number) {
  const std::vector<std::string> shapes = namesIn(number.onlyWith);
  return shapes.empty() || std::ranges::find(shapes, form.name) != shapes.end();
}

std::vector<SettingField<Body>> bodyNumbersOf(const BodyForm& form) {
  std::vector<SettingField<Body>> numbers;
  for (const SettingField<Body>& number : bodyNumbers())
    if (hasNumber(form, number)) numbers.push_back(number);
  return numbers;
}

}  // namespace ringlet
