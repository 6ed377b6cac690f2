// Bodies, what hair stays out of, and meshes that they are made of.
#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>
#include <utility>

#include "python/arrays.h"
#include "python/poses.h"
#include "python/setting_values.h"
#include "ringlet/base/bounds.h"
#include "ringlet/bodies/body_distance.h"
#include "ringlet/bodies/head_mesh.h"
#include "ringlet/bodies/make_bending_mesh.h"
#include "ringlet/bodies/mesh_file.h"
#include "ringlet/bodies/mesh_grid.h"
#include "ringlet/groom/generate.h"
#include "ringlet/scene/body_forms.h"

namespace ringlet::python {
namespace {

// What carries a body, and where in its frame it is.
struct Stand {
  std::string name;
  BodyPose place;
  std::optional<MotionObject> motion;
};

// `sizes`, by place, are the numbers that only some shapes have, in their order.
Body bodyOf(const BodyForm& form, const Stand& stand, const py::args& sizes, py::kwargs numbers) {
  Body body{.name = stand.name, .shape = form.shape, .place = stand.place};
  if (stand.motion) body.motion = stand.motion->motion;
  const std::vector<SettingField<Body>> rows = bodyNumbersOf(form);
  std::size_t given = 0;
  for (const SettingField<Body>& row : rows) {
    if (row.onlyWith.empty()) continue;
    if (given == sizes.size()) break;
    if (numbers.contains(row.key))
      throw py::type_error(fmt::format("Body.{} got two values for {}", form.name, row.key));
    numbers[row.key] = sizes[given++];
  }
  if (given < sizes.size())
    throw py::type_error(
        fmt::format("Body.{} takes {} numbers by place, got {}", form.name, given, sizes.size()));
  setNumbers<Body>(rows, form.name.data(), {"name", "position", "rotation", "motion"}, numbers, body);
  return body;
}
BodyObject checked(Body body, std::vector<std::string> warnings = {}) {
  demand(checkBody(body));
  return {std::move(body), std::move(warnings)};
}

// (points, 3) and (triangles, 3), whole.
TriangleMesh meshOf(const py::object& points, const py::object& triangles) {
  TriangleMesh mesh;
  const Rows rows = rowsOf(points, "points", 3);
  for (std::size_t i = 0; i < rows.count(3); ++i)
    mesh.points.push_back({rows.values[3 * i], rows.values[3 * i + 1], rows.values[3 * i + 2]});
  const Rows corners = rowsOf(triangles, "triangles", 3);
  const auto index = [&](double corner) {
    if (corner != std::floor(corner) || corner < 0 || corner >= static_cast<double>(mesh.points.size()))
      throw py::value_error(
          fmt::format("triangles must be indices of the {} points, got {}", mesh.points.size(), corner));
    return static_cast<std::uint32_t>(corner);
  };
  for (std::size_t t = 0; t < corners.count(3); ++t)
    mesh.triangles.push_back(
        {index(corners.values[3 * t]), index(corners.values[3 * t + 1]), index(corners.values[3 * t + 2])});
  return mesh;
}

py::tuple arraysOf(const TriangleMesh& mesh) {
  py::array_t<std::uint32_t> triangles(
      {static_cast<py::ssize_t>(mesh.triangles.size()), static_cast<py::ssize_t>(3)});
  std::uint32_t* out = triangles.mutable_data();
  for (const auto& triangle : mesh.triangles)
    for (const std::uint32_t corner : triangle) *out++ = corner;
  return py::make_tuple(arrayOf(mesh.points), triangles);
}

// (low, high), or None.
std::optional<Bounds> boundsOf(const py::object& value) {
  if (value.is_none()) return std::nullopt;
  const Rows corners = rowsOf(value, "grid", 3);
  if (corners.count(3) != 2)
    throw py::value_error(fmt::format("grid is two corners, (low, high); got {}", corners.count(3)));
  const std::vector<double>& v = corners.values;
  return Bounds{{v[0], v[1], v[2]}, {v[3], v[4], v[5]}};
}

Stand standOf(const std::string& name, const py::object& position, const py::object& rotation,
              const std::optional<MotionObject>& motion) {
  return {name, {vectorOf(position, "position"), rotationOf(rotation, "rotation")}, motion};
}

// As Python gives it.
struct MeshGiven {
  TriangleMesh mesh;
  int cells = 64;
  bool deforms = false;
  std::optional<Bounds> grid{};
  bool isCloth = false;
};

BodyObject bendingBody(MeshGiven given, Body body) {
  const BendingRoom room = bendingRoomOf(given.mesh.points, given.grid, given.cells, given.isCloth);
  std::vector<std::string> warnings;
  withoutGil([&] { demand(makeBendingMesh(std::move(given.mesh), room, body, warnings)); });
  return checked(std::move(body), std::move(warnings));
}

BodyObject meshBody(MeshGiven given, const Stand& stand, const py::kwargs& numbers) {
  Body body = bodyOf(formOf(BodyShape::grid), stand, {}, numbers);
  if (given.deforms) return bendingBody(std::move(given), std::move(body));
  if (given.isCloth) throw py::value_error("sides=\"both\" is for a mesh with deforms=True");
  if (given.grid) throw py::value_error("grid is for a mesh with deforms=True");
  MeshGrid made = withoutGil([&] { return valueOf(makeDistanceGrid(given.mesh, {.cells = given.cells})); });
  body.grid = std::make_shared<const DistanceGrid>(std::move(made.grid));
  return checked(std::move(body), std::move(made.warnings));
}

py::tuple headMesh(double scalpRadius, double browElevation, double napeElevation) {
  HeadParameters head;
  const auto demandIn = [](const char* name, double value, double low, double high) {
    if (!(value >= low && value <= high))
      throw py::value_error(fmt::format("{} must be from {} to {}, got {}", name, low, high, value));
    return value;
  };
  head.scalpRadius = demandIn("scalp_radius", scalpRadius, 1e-6, 10);
  head.browElevation = demandIn("brow_elevation", browElevation, -1.5, 1.5);
  head.napeElevation = demandIn("nape_elevation", napeElevation, -1.5, 1.5);
  return arraysOf(makeHeadMesh(head));
}

py::array_t<double> distances(const BodyObject& self, const py::object& points, const py::object& pose) {
  const PointsIn in(points, "points");
  demandFinite(in.points(), "points");
  const HeadPose at =
      pose.is_none() ? HeadPose{self.body.place.position, self.body.place.rotation} : poseOf(pose, "pose");
  return arrayOf(withoutGil([&] {
    std::vector<double> all;
    for (const Vec3f& p : in.points())
      all.push_back(distanceTo(self.body, BodyPose{at.position, at.rotation}, Vec3d(p)));
    return all;
  }));
}

#define RINGLET_STAND                                                  \
  py::arg("name") = "", py::arg("position") = py::make_tuple(0, 0, 0), \
  py::arg("rotation") = py::make_tuple(0, 0, 0, 1), py::arg("motion") = py::none()

std::string bodyReprOf(const BodyObject& self) {
  const Body& body = self.body;
  std::string size;
  for (const SettingField<Body>& row : bodyNumbersOf(formOf(body.shape))) {
    if (row.onlyWith.empty()) continue;
    const py::object value = std::visit([&](auto member) { return toPython(body.*member); }, row.member);
    size += fmt::format(", {} {} m", row.key, py::repr(value).cast<std::string>());
  }
  const Vec3d& at = body.place.position;
  return fmt::format("<ringlet.Body{}: a {}{}, at ({}, {}, {}){}>", body.name.empty() ? "" : " " + body.name,
                     formOf(body.shape).name, size, at.x, at.y, at.z,
                     body.motion ? ", with a motion of its own" : "");
}

void addShape(py::class_<BodyObject>& bodies, const BodyForm& form) {
  const std::string doc = fmt::format("A {}. Its numbers, by name, sizes also by place:{}", form.name,
                                      numbersText<Body>(bodyNumbersOf(form)));
  bodies.def_static(
      form.name.data(),
      [&form](const py::args& sizes, const std::string& name, const py::object& position,
              const py::object& rotation, const std::optional<MotionObject>& motion,
              const py::kwargs& numbers) {
        return checked(bodyOf(form, standOf(name, position, rotation, motion), sizes, numbers));
      },
      RINGLET_STAND, doc.c_str());
}

void addMesh(py::class_<BodyObject>& bodies) {
  const std::string doc =
      "A closed surface: points (points, 3) [m], triangles (triangles, 3) indices, counterclockwise seen from "
      "outside, as read_mesh and make_head_mesh give them. cells: of its distance grid, along its longest side, "
      "8 to 256. deforms: it bends, and every frame gives its points (Hair.step); grid: then the box in which "
      "hair can meet it, (low, high) in its own frame; None: about all of it. sides: out, or both for cloth that "
      "deforms, open or closed, whose both sides hold hair off, by its thickness, 0.5 mm at least. Takes about a "
      "second. Its numbers, by name:" +
      numbersText<Body>(bodyNumbersOf(formOf(BodyShape::grid)));
  bodies.def_static(
      "mesh",
      [](const py::object& points, const py::object& triangles, int cells, bool deforms,
         const py::object& grid, const std::string& sides, const std::string& name,
         const py::object& position, const py::object& rotation, const std::optional<MotionObject>& motion,
         const py::kwargs& numbers) {
        if (sides != "out" && sides != "both")
          throw py::value_error(fmt::format("sides must be out or both, got {}", sides));
        return meshBody({meshOf(points, triangles), cells, deforms, boundsOf(grid), sides == "both"},
                        standOf(name, position, rotation, motion), numbers);
      },
      py::arg("points"), py::arg("triangles"), py::kw_only(), py::arg("cells") = 64,
      py::arg("deforms") = false, py::arg("grid") = py::none(), py::arg("sides") = "out", RINGLET_STAND,
      doc.c_str());
}

void addBody(py::module_& module) {
  py::class_<BodyObject> bodies(
      module, "Body",
      "What hair stays out of; solid. Constant. All shapes take: name, for messages; position [m] and rotation "
      "in the frame of what carries it: the head's, or that of a motion of its own. ValueError for a number out "
      "of its range.");
  for (const BodyForm& form : bodyForms())
    if (form.shape != BodyShape::grid) addShape(bodies, form);
  addMesh(bodies);
  bodies
      .def("distances", &distances, py::arg("points"), py::arg("pose") = py::none(),
           "(points,) float64: how far points, (points, 3) float32 [m] in the world, are from its surface, "
           "negative inside, with the body at a Pose; None: where its position and rotation say.")
      .def_property_readonly(
          "name", [](const BodyObject& self) { return self.body.name; }, "For messages.")
      .def_property_readonly(
          "shape", [](const BodyObject& self) { return nameOf(self.body.shape); },
          "\"sphere\", \"capsule\", \"plane\", \"box\" or \"mesh\".")
      .def_readonly("warnings", &BodyObject::warnings,
                    "What was odd about its mesh, as holes that were closed: a list of sentences.")
      .def("__repr__", &bodyReprOf, "What it is, in a line.");
}

}  // namespace

void addBodies(py::module_& module) {
  addBody(module);
  module.def(
      "read_mesh",
      [](const std::filesystem::path& path, double metresPerUnit) {
        if (!(metresPerUnit >= 1e-6 && metresPerUnit <= 1000))
          throw py::value_error(
              fmt::format("metres_per_unit must be from 1e-06 to 1000, got {}", metresPerUnit));
        return arraysOf(withoutGil([&] { return valueOf(readObjMesh(path, metresPerUnit)); }));
      },
      py::arg("path"), py::arg("metres_per_unit") = 1.0,
      "The surface in an .obj file: points (points, 3) float64 [m], triangles (triangles, 3) uint32. "
      "ringlet.Error for a file that is missing or broken.");
  const HeadParameters h;
  module.def("make_head_mesh", &headMesh, py::kw_only(), py::arg("scalp_radius") = h.scalpRadius,
             py::arg("brow_elevation") = h.browElevation, py::arg("nape_elevation") = h.napeElevation,
             "The head that make_head's hair grows on, with face and neck: points (points, 3) float64 [m], "
             "triangles (triangles, 3) uint32.");
}

}  // namespace ringlet::python
