// Materials: their numbers by name, checked by the library's tables (rest/material_parameters.h).
#include "python/materials.h"

#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string_view>

#include "python/arrays.h"
#include "ringlet/rest/material_file.h"
#include "ringlet/rest/material_parameters.h"
#include "ringlet/rest/material_presets.h"

namespace ringlet::python {
namespace {

constexpr std::string_view kDials = "dials.", kVariation = "variation.", kProfile = "profile.";

// Calls use(owner, parameters) for the table a key belongs to, with the key's own name.
template <class Self, class Use>
auto inTable(Self& self, std::string_view key, Use&& use) {
  if (key.starts_with(kDials)) return use(self.dials, dialParameters(), key.substr(kDials.size()));
  if (key.starts_with(kVariation))
    return use(self.material.variation, variationParameters(), key.substr(kVariation.size()));
  return use(self.material, materialParameters(), key);
}

template <class Owner>
const Parameter<Owner>* find(std::span<const Parameter<Owner>> parameters, std::string_view key) {
  const auto found =
      std::ranges::find(parameters, key, [](const auto& p) { return std::string_view(p.key); });
  return found == parameters.end() ? nullptr : &*found;
}
const ProfileParameter* findProfile(std::string_view key) {
  if (!key.starts_with(kProfile)) return nullptr;
  for (const ProfileParameter& parameter : profileParameters())
    if (key.substr(kProfile.size()) == parameter.key) return &parameter;
  return nullptr;
}

std::vector<std::string> materialKeys() {
  std::vector<std::string> keys;
  const auto add = [&](std::string_view table, const auto& parameters) {
    for (const auto& parameter : parameters) keys.push_back(fmt::format("{}{}", table, parameter.key));
  };
  add("", materialParameters());
  add(kDials, dialParameters());
  add(kVariation, variationParameters());
  add(kProfile, profileParameters());
  return keys;
}

std::string unknownMaterialKey(std::string_view key) {
  return unknownName("number of a material", key, materialKeys());
}

py::object optionalOf(const std::optional<double>& value, bool isWhole) {
  if (!value) return py::none();
  return isWhole ? py::object(py::int_(static_cast<long long>(*value))) : py::object(py::float_(*value));
}

// Throws what a wrong value is called.
template <class Owner>
void setNumber(Owner& owner, const Parameter<Owner>& parameter, const std::string& key,
               const py::object& value) {
  std::optional<double> number;
  if (!value.is_none() || !parameter.canBeUnset())
    number = parameter.isWhole() ? static_cast<double>(wholeNumberOf(value, key)) : numberOf(value, key);
  if (number && !parameter.allowed.contains(*number))
    throw py::value_error(
        fmt::format("{} must be {}, got {}", key, rangeText(parameter.allowed, parameter.unit), *number));
  parameter.set(owner, number);
}

py::list profilePointsOf(const Profile& profile) {
  py::list points;
  for (const Profile::Point& point : profile.points) points.append(py::make_tuple(point.s, point.factor));
  return points;
}

void setProfile(Material& material, const ProfileParameter& parameter, const py::object& value) {
  Profile profile;
  if (!value.is_none() && !(py::isinstance<py::sequence>(value) && py::len(value) == 0)) {
    const Rows rows = rowsOf(value, (std::string(kProfile) + parameter.key).c_str(), 2);
    if (rows.shape.size() != 1)
      throw py::value_error(fmt::format("{}{} takes points (share of the length, factor), got {}", kProfile,
                                        parameter.key, describe(value)));
    for (std::size_t i = 0; i < rows.count(2); ++i)
      profile.points.push_back({rows.values[2 * i], rows.values[2 * i + 1]});
  }
  if (Status checked = checkProfile(parameter, profile); !checked)
    throw py::value_error(checked.error().message);
  material.*parameter.member = std::move(profile);
}

// Whether there is such a number.
bool setParameter(MaterialObject& self, const std::string& key, const py::object& value) {
  if (const ProfileParameter* profile = findProfile(key))
    return setProfile(self.material, *profile, value), true;
  return inTable(self, key, [&](auto& owner, auto parameters, std::string_view name) {
    const auto* parameter = find(parameters, name);
    if (parameter) setNumber(owner, *parameter, key, value);
    return parameter != nullptr;
  });
}
std::optional<py::object> getParameter(const MaterialObject& self, const std::string& key) {
  if (const ProfileParameter* profile = findProfile(key))
    return profilePointsOf(self.material.*profile->member);
  return inTable(self, key, [&](auto& owner, auto parameters, std::string_view name) {
    const auto* parameter = find(parameters, name);
    return parameter ? std::optional(optionalOf(parameter->of(owner), parameter->isWhole())) : std::nullopt;
  });
}

// Several, of which all are set or none.
void setAll(MaterialObject& self, const py::kwargs& numbers) {
  MaterialObject changed = self;
  for (const auto& [key, value] : numbers) {
    if (!setParameter(changed, key.cast<std::string>(), py::reinterpret_borrow<py::object>(value)))
      throw py::type_error(unknownMaterialKey(key.cast<std::string>()));
  }
  self = std::move(changed);
}

MaterialObject presetNamed(const std::string& name) {
  const auto found = materialPreset(name);
  if (!found) throw py::value_error(unknownName("preset", name, presetNames()));
  return {*found, {}};
}

MaterialObject loadMaterial(const std::filesystem::path& path) {
  LoadedMaterial loaded = withoutGil([&] { return python::valueOf(readMaterial(path)); });
  return {std::move(loaded.material), loaded.dials, std::move(loaded.warnings)};
}

py::dict describeParameter(const ParameterText& text, const std::string& key, py::object standard) {
  py::dict row;
  row["key"] = key, row["unit"] = text.unit, row["effect"] = text.effect;
  row["low"] = text.allowed.low, row["high"] = text.allowed.high;
  row["usual_low"] = text.usual.low, row["usual_high"] = text.usual.high;
  row["default"] = std::move(standard);
  return row;
}
py::list listParameters() {
  py::list list;
  const auto add = [&](std::string_view table, const auto& parameters) {
    for (const auto& p : parameters)
      list.append(
          describeParameter(p, fmt::format("{}{}", table, p.key), optionalOf(p.defaultValue(), p.isWhole())));
  };
  add("", materialParameters());
  add(kDials, dialParameters());
  add(kVariation, variationParameters());
  for (const ProfileParameter& p : profileParameters())
    list.append(describeParameter(p, fmt::format("{}{}", kProfile, p.key), py::list()));
  return list;
}

std::string materialReprOf(const MaterialObject& self) {
  const MaterialObject standard{};
  std::string changed;
  for (const std::string& key : materialKeys()) {
    const py::object value = *getParameter(self, key);
    if (!value.equal(*getParameter(standard, key)))
      changed += fmt::format("{}{}={}", changed.empty() ? "" : ", ", key, std::string(py::repr(value)));
  }
  return fmt::format("<ringlet.Material: {}>", changed.empty() ? "the default" : changed);
}

std::string parameterDocOf(const ParameterText& text) {
  const std::string unit = text.unit == std::string("1") ? "" : fmt::format(" [{}]", text.unit);
  return fmt::format("{}{} Allowed {}; usual {}.", text.effect, unit, rangeText(text.allowed, text.unit),
                     rangeText(text.usual, text.unit));
}

// An attribute a number of the material itself.
template <class Class>
void addParameters(Class& material) {
  for (const Parameter<Material>& parameter : materialParameters()) {
    const std::string key = parameter.key;
    material.def_property(
        parameter.key,
        py::cpp_function([key](const MaterialObject& self) { return *getParameter(self, key); }),
        py::cpp_function(
            [key](MaterialObject& self, const py::object& value) { setParameter(self, key, value); }),
        parameterDocOf(parameter).c_str());
  }
  material
      .def(
          "__getattr__",
          [](const py::object&, const std::string& name) -> py::object {
            throw py::attribute_error(unknownMaterialKey(name));
          },
          py::arg("name"), "AttributeError with the nearest name: asked only for what there is not.")
      .def(
          "__setattr__",
          [](const py::object& self, const py::str& name, const py::object& value) {
            if (!py::hasattr(py::type::of(self), name))
              throw py::attribute_error(unknownMaterialKey(std::string(name)));
            if (PyObject_GenericSetAttr(self.ptr(), name.ptr(), value.ptr()) != 0)
              throw py::error_already_set();
          },
          py::arg("name"), py::arg("value"), "AttributeError for a name that there is not.");
}

using MaterialClass = py::class_<MaterialObject>;

// The ways to make one.
void addMaterialSources(MaterialClass& material) {
  material
      .def(py::init([](const py::kwargs& numbers) {
             MaterialObject made;
             setAll(made, numbers);
             return made;
           }),
           "The default material, but for these numbers by name. TypeError for a name that there is not, "
           "ValueError for a number out of its range.")
      .def_static(
          "preset",
          [](const std::string& name, const py::kwargs& numbers) {
            MaterialObject made = presetNamed(name);
            setAll(made, numbers);
            return made;
          },
          py::arg("name"), "One of presets(), but for these numbers by name. ValueError for another name.")
      .def_static(
          "presets",
          [] {
            py::dict presets;
            for (const std::string& name : presetNames()) presets[name.c_str()] = presetSummary(name);
            return presets;
          },
          "The presets by name, from straight hair to the tightest curls, with what each looks like: a dict.")
      .def_static("load", &loadMaterial, py::arg("path"),
                  "Reads a material file (TOML). ringlet.Error with file and line for what is wrong in it.")
      .def_static(
          "parameters", &listParameters,
          "Every number: a list of dicts of key, unit, effect, low and high (beyond them is refused), "
          "usual_low and usual_high, default. None: measured on the rest curl.");
}

void addMaterialFile(MaterialClass& material) {
  material
      .def(
          "write",
          [](const MaterialObject& self, const std::filesystem::path& path) {
            withoutGil([&] { demand(writeMaterial(path, self.material, self.dials)); });
          },
          py::arg("path"), "Writes a material file with every number, its unit, effect and range beside it.")
      .def_readonly("warnings", &MaterialObject::warnings,
                    "Numbers of its file that are allowed but unusual: a list of sentences.")
      .def(
          "copy", [](const MaterialObject& self) { return self; }, "Another one with the same numbers.")
      .def(
          "__copy__", [](const MaterialObject& self) { return self; }, "As copy.")
      .def(
          "__deepcopy__", [](const MaterialObject& self, const py::object&) { return self; }, py::arg("memo"),
          "As copy.");
}

// Its numbers by name.
void addMaterialNumbers(MaterialClass& material) {
  material
      .def(
          "keys", [](const py::object&) { return materialKeys(); }, "The names of all numbers: a list.")
      .def(
          "__getitem__",
          [](const MaterialObject& self, const std::string& key) {
            const auto value = getParameter(self, key);
            if (!value) throw py::key_error(unknownMaterialKey(key));
            return *value;
          },
          py::arg("key"),
          "A number by name; None where it is measured on the rest curl. A profile is a list of points.")
      .def(
          "__setitem__",
          [](MaterialObject& self, const std::string& key, const py::object& value) {
            if (!setParameter(self, key, value)) throw py::key_error(unknownMaterialKey(key));
          },
          py::arg("key"), py::arg("value"),
          "KeyError for a name that there is not, ValueError for a number out of its range.")
      .def(
          "__contains__",
          [](const MaterialObject& self, const std::string& key) {
            return getParameter(self, key).has_value();
          },
          py::arg("key"), "Whether there is such a number.")
      .def(
          "__eq__",
          [](const MaterialObject& self, const py::object& other) {
            if (!py::isinstance<MaterialObject>(other)) return false;
            const auto& o = other.cast<const MaterialObject&>();
            return self.material == o.material && self.dials == o.dials;
          },
          py::arg("other"), "Whether all numbers are the same.")
      .def("__repr__", &materialReprOf, "The numbers that are not the default.");
}

}  // namespace

Material dialled(const MaterialObject& object, std::vector<std::string>& warnings) {
  Material material = object.material;
  if (const auto warning = applyDials(object.dials, material)) warnings.push_back(*warning);
  if (Status checked = checkMaterial(material); !checked) {
    const MaterialDials& dials = object.dials;
    if (dials == MaterialDials{}) throw Failure(checked.error());
    throw Failure(
        {fmt::format("{}, with the dials worked in: {}", checked.error().message, dialsText(dials))});
  }
  return material;
}

void addMaterials(py::module_& module) {
  MaterialClass material(
      module, "Material",
      "What hair is made of: numbers by name, as `material[\"bend_stiffness\"]` or "
      "`material.bend_stiffness`. Names with a table in front, \"dials.hold\", \"variation.bend_stiffness\", "
      "\"profile.bend_stiffness\", have brackets only. Material.parameters() lists all with units and "
      "ranges. Numbers of unit w are multiples of a strand's own weight.\n\n"
      "Dials are worked in where the material is used.");
  addMaterialSources(material);
  addMaterialFile(material);
  addMaterialNumbers(material);
  material.attr("__hash__") = py::none();  // it changes
  addParameters(material);
}

}  // namespace ringlet::python
