// Force fields: what acts on hair at places in the world.
#include <fmt/format.h>
#include <pybind11/stl.h>

#include <memory>
#include <string>

#include "python/arrays.h"
#include "python/poses.h"
#include "python/setting_values.h"
#include "ringlet/scene/force_field.h"

namespace ringlet::python {
namespace {

// (x, y, z, 3), as the last index goes fastest.
std::shared_ptr<const VelocityGrid> gridOf(const py::object& value, double cell) {
  if (value.is_none()) return nullptr;
  const Rows rows = rowsOf(value, "grid", 3);
  if (rows.shape.size() != 3) throw py::value_error("grid has shape (x, y, z, 3)");
  VelocityGrid grid;
  grid.cell = cell;
  for (std::size_t k = 0; k < 3; ++k) {
    if (rows.shape[k] < 2 || rows.shape[k] > 4096)
      throw py::value_error(fmt::format("grid has from 2 to 4096 nodes on a side, got {}", rows.shape[k]));
    grid.nodes[k] = static_cast<std::uint32_t>(rows.shape[k]);
  }
  grid.velocities.resize(rows.count(3));
  std::size_t from = 0;
  for (std::size_t x = 0; x < grid.nodes[0]; ++x)
    for (std::size_t y = 0; y < grid.nodes[1]; ++y)
      for (std::size_t z = 0; z < grid.nodes[2]; ++z, from += 3)
        grid.velocities[(z * grid.nodes[1] + y) * grid.nodes[0] + x] =
            static_cast<Vec3f>(Vec3d{rows.values[from], rows.values[from + 1], rows.values[from + 2]});
  return std::make_shared<const VelocityGrid>(std::move(grid));
}

ForceField fieldOf(const py::object& position, const py::object& rotation, const py::object& grid,
                   double cell, const std::string& name, const py::kwargs& numbers) {
  ForceField field{.name = name,
                   .place = {vectorOf(position, "position"), rotationOf(rotation, "rotation")},
                   .grid = gridOf(grid, cell)};
  setNumbers(forceFieldNumbers(), "field", {"position", "rotation", "grid", "cell", "name"}, numbers, field);
  demand(checkForceField(field));
  return field;
}

}  // namespace

void addFields(py::module_& module) {
  const std::string doc =
      "position [m], rotation: of its place; of a grid, of its first node. grid: velocities of air, "
      "(x, y, z, 3), cell apart [m]. Numbers, by name, each with its default; ringlet.Error and ValueError "
      "for one out of its range:" +
      numbersText(forceFieldNumbers());
  py::class_<ForceField>(
      module, "Field",
      "A field of force, or of air that moves, in the world. Constant. Strengths are accelerations [m/s^2]; "
      "with drag they are velocities of the air [m/s].")
      .def(py::init(&fieldOf), py::kw_only(), py::arg("position") = py::make_tuple(0, 0, 0),
           py::arg("rotation") = py::make_tuple(0, 0, 0, 1), py::arg("grid") = py::none(),
           py::arg("cell") = VelocityGrid{}.cell, py::arg("name") = "", doc.c_str())
      .def_property_readonly(
          "name", [](const ForceField& field) { return field.name; }, "For messages.")
      .def(
          "__repr__",
          [](const ForceField& field) {
            const Vec3d& p = field.place.position;
            return fmt::format("<ringlet.Field: {}at ({:g}, {:g}, {:g})>",
                               field.name.empty() ? "" : field.name + " ", p.x, p.y, p.z);
          },
          "What it is, in a line.");
}

}  // namespace ringlet::python
