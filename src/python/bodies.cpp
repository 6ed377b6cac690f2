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
#include "ringlet/bodies/body_distance.h"
#include "ringlet/bodies/head_mesh.h"
#include "ringlet/bodies/mesh_file.h"
#include "ringlet/bodies/mesh_grid.h"
#include "ringlet/groom/generate.h"
#include "ringlet/scene/body_forms.h"

namespace ringlet::python {
namespace {

// What every body has besides its shape.
Body commonOf(BodyShape shape, const std::string& name, double thickness, double friction,
              const py::object& position, const py::object& rotation,
              const std::optional<MotionObject>& motion) {
  Body body;
  body.name = name;
  body.shape = shape;
  body.thickness = thickness;
  body.friction = friction;
  body.place = {vectorOf(position, "position"), rotationOf(rotation, "rotation")};
  if (motion) body.motion = motion->motion;
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

BodyObject meshBody(const py::object& points, const py::object& triangles, int cells, const std::string& name,
                    double thickness, double friction, const py::object& position, const py::object& rotation,
                    const std::optional<MotionObject>& motion) {
  const TriangleMesh mesh = meshOf(points, triangles);
  Body body = commonOf(BodyShape::grid, name, thickness, friction, position, rotation, motion);
  MeshGrid made = withoutGil([&] { return valueOf(makeDistanceGrid(mesh, {.cells = cells})); });
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

#define RINGLET_COMMON_ARGUMENTS                                                                   \
  py::arg("name") = "", py::arg("thickness") = 0.0, py::arg("friction") = 0.2,                     \
  py::arg("position") = py::make_tuple(0, 0, 0), py::arg("rotation") = py::make_tuple(0, 0, 0, 1), \
  py::arg("motion") = py::none()

std::string bodyReprOf(const BodyObject& self) {
  const Body& body = self.body;
  std::string size;
  if (body.shape == BodyShape::sphere) size = fmt::format(" of radius {} m", body.radius);
  if (body.shape == BodyShape::capsule)
    size = fmt::format(" of radius {} m and length {} m", body.radius, body.length);
  if (body.shape == BodyShape::box)
    size = fmt::format(" of half extents ({}, {}, {}) m", body.halfExtents.x, body.halfExtents.y,
                       body.halfExtents.z);
  const Vec3d& at = body.place.position;
  return fmt::format("<ringlet.Body{}: a {}{} at ({}, {}, {}){}>", body.name.empty() ? "" : " " + body.name,
                     formOf(body.shape).name, size, at.x, at.y, at.z,
                     body.motion ? ", with a motion of its own" : "");
}

void addBody(py::module_& module) {
  py::class_<BodyObject>(
      module, "Body",
      "What hair stays out of; solid. Constant. All shapes take: name, for messages; thickness: hair keeps "
      "this much further away [m]; friction: Coulomb's coefficient; position [m] and rotation in the frame "
      "of what carries it: the head's, or that of a motion of its own. ringlet.Error for a number out of its "
      "range.")
      .def_static(
          "sphere",
          [](double radius, const std::string& name, double thickness, double friction,
             const py::object& position, const py::object& rotation,
             const std::optional<MotionObject>& motion) {
            Body body = commonOf(BodyShape::sphere, name, thickness, friction, position, rotation, motion);
            body.radius = radius;
            return checked(std::move(body));
          },
          py::arg("radius"), py::kw_only(), RINGLET_COMMON_ARGUMENTS, "Of this radius about its origin [m].")
      .def_static(
          "capsule",
          [](double radius, double length, const std::string& name, double thickness, double friction,
             const py::object& position, const py::object& rotation,
             const std::optional<MotionObject>& motion) {
            Body body = commonOf(BodyShape::capsule, name, thickness, friction, position, rotation, motion);
            body.radius = radius, body.length = length;
            return checked(std::move(body));
          },
          py::arg("radius"), py::arg("length"), py::kw_only(), RINGLET_COMMON_ARGUMENTS,
          "All within this radius of a line of this length along Y, its middle at the origin [m].")
      .def_static(
          "plane",
          [](const std::string& name, double thickness, double friction, const py::object& position,
             const py::object& rotation, const std::optional<MotionObject>& motion) {
            return checked(commonOf(BodyShape::plane, name, thickness, friction, position, rotation, motion));
          },
          py::kw_only(), RINGLET_COMMON_ARGUMENTS, "The half space below Y = 0.")
      .def_static(
          "box",
          [](const py::object& halfExtents, const std::string& name, double thickness, double friction,
             const py::object& position, const py::object& rotation,
             const std::optional<MotionObject>& motion) {
            Body body = commonOf(BodyShape::box, name, thickness, friction, position, rotation, motion);
            body.halfExtents = vectorOf(halfExtents, "half_extents");
            return checked(std::move(body));
          },
          py::arg("half_extents"), py::kw_only(), RINGLET_COMMON_ARGUMENTS,
          "So far to either side of its origin along X, Y and Z [m].")
      .def_static(
          "mesh", &meshBody, py::arg("points"), py::arg("triangles"), py::kw_only(), py::arg("cells") = 64,
          RINGLET_COMMON_ARGUMENTS,
          "A closed surface: points (points, 3) [m], triangles (triangles, 3) indices, counterclockwise seen "
          "from outside, as read_mesh and make_head_mesh give them. cells: of its distance grid, along its "
          "longest side, 8 to 256. Takes about a second.")
      .def("distances", &distances, py::arg("points"), py::arg("pose") = py::none(),
           "(points,) float64: how far points, (points, 3) float32 [m] in the world, are from its surface, "
           "negative inside, with the body at a Pose; None: where its position and rotation say.")
      .def_property_readonly(
          "name", [](const BodyObject& self) { return self.body.name; }, "For messages.")
      .def_property_readonly(
          "shape", [](const BodyObject& self) { return formOf(self.body.shape).name; },
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
