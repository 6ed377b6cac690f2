// Settings: attributes and names made of the library's tables (scene/settings_fields.h).
#include "python/settings.h"

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <string_view>
#include <type_traits>

#include "python/arrays.h"
#include "python/setting_values.h"
#include "ringlet/scene/settings_fields.h"

namespace ringlet::python {
namespace {

constexpr std::string_view kContacts = "contacts.", kAir = "air.", kGoal = "goal.",
                           kIntegrator = "integrator";

template <class Owner>
constexpr std::string_view kTable = "";
template <>
constexpr std::string_view kTable<ContactSettings> = kContacts;
template <>
constexpr std::string_view kTable<AirSettings> = kAir;
template <>
constexpr std::string_view kTable<GoalSettings> = kGoal;

template <class Owner>
std::span<const SettingField<Owner>> fieldsOf() {
  if constexpr (std::is_same_v<Owner, ContactSettings>) return contactFields();
  if constexpr (std::is_same_v<Owner, AirSettings>) return airFields();
  if constexpr (std::is_same_v<Owner, GoalSettings>) return goalFields();
  if constexpr (std::is_same_v<Owner, Settings>) return settingsFields();
}

template <class Owner>
std::vector<std::string> keysOf(std::string_view table) {
  std::vector<std::string> keys;
  if constexpr (std::is_same_v<Owner, Settings>) keys.emplace_back(kIntegrator);
  for (const auto& field : fieldsOf<Owner>()) keys.push_back(fmt::format("{}{}", table, field.key));
  return keys;
}
std::vector<std::string> settingKeys() {
  std::vector<std::string> keys = keysOf<Settings>("");
  for (const auto& more :
       {keysOf<ContactSettings>(kContacts), keysOf<AirSettings>(kAir), keysOf<GoalSettings>(kGoal)})
    keys.insert(keys.end(), more.begin(), more.end());
  return keys;
}
std::string unknownSetting(std::string_view key) { return unknownName("setting", key, settingKeys()); }

// The type of an attribute, as the stubs write it.
std::string typeOf(const auto&) { return "object"; }  // types that no setting of these tables has
std::string typeOf(double) { return "float"; }
std::string typeOf(int) { return "int"; }
std::string typeOf(std::uint32_t) { return "int"; }
std::string typeOf(bool) { return "bool"; }
std::string typeOf(Vec3d) { return "tuple[float, float, float]"; }
std::string typeOf(ContactTaper) { return "str"; }
std::string typeOf(ContactMethod) { return "str"; }
template <class T>
std::string typeOf(const std::optional<T>&) {
  return typeOf(T{}) + " | None";
}

template <class Owner>
std::optional<py::object> getField(const Owner& owner, std::string_view key) {
  const SettingField<Owner>* field = fieldNamed(fieldsOf<Owner>(), key);
  if (!field) return std::nullopt;
  return std::visit([&](auto member) { return toPython(owner.*member); }, field->member);
}
template <class Owner>
bool setField(Owner& owner, std::string_view key, const std::string& name, const py::object& value) {
  const SettingField<Owner>* field = fieldNamed(fieldsOf<Owner>(), key);
  if (!field) return false;
  std::visit([&](auto member) { fromPython(*field, name, value, owner.*member); }, field->member);
  return true;
}

std::optional<py::object> getKey(const Settings& self, std::string_view key) {
  if (key == kIntegrator) return py::str(kIntegratorNames[static_cast<int>(self.integrator)]);
  if (key.starts_with(kContacts)) return getField(self.contacts, key.substr(kContacts.size()));
  if (key.starts_with(kAir)) return getField(self.air, key.substr(kAir.size()));
  if (key.starts_with(kGoal)) return getField(self.goal, key.substr(kGoal.size()));
  return getField(self, key);
}
bool setKey(Settings& self, const std::string& key, const py::object& value) {
  const std::string_view name = key;
  if (name == kIntegrator) {
    const std::vector<std::string> words(std::begin(kIntegratorNames), std::end(kIntegratorNames));
    self.integrator = static_cast<Integrator>(wordIn(value, words, key));
    return true;
  }
  if (name.starts_with(kContacts)) return setField(self.contacts, name.substr(kContacts.size()), key, value);
  if (name.starts_with(kAir)) return setField(self.air, name.substr(kAir.size()), key, value);
  if (name.starts_with(kGoal)) return setField(self.goal, name.substr(kGoal.size()), key, value);
  return setField(self, name, key, value);
}

// A table whole, of another or of a dict.
template <class Owner>
void setTable(Owner& owner, const py::object& value, std::string_view table) {
  if (py::isinstance<Owner>(value)) {
    owner = value.cast<const Owner&>();
    return;
  }
  if (!py::isinstance<py::dict>(value))
    throw py::type_error(fmt::format("{} takes settings of its own or a dict of them, got {}",
                                     table.substr(0, table.size() - 1), describe(value)));
  Owner changed = owner;
  for (const auto& [key, entry] : py::reinterpret_borrow<py::dict>(value)) {
    const std::string name = fmt::format("{}{}", table, std::string(py::str(key)));
    if (!setField(changed, name.substr(table.size()), name, py::reinterpret_borrow<py::object>(entry)))
      throw py::type_error(unknownSetting(name));
  }
  owner = changed;
}

template <class Owner>
py::dict describeField(const SettingField<Owner>& field) {
  const Owner standard{};
  py::dict row;
  row["key"] = fmt::format("{}{}", kTable<Owner>, field.key);
  row["unit"] = field.unit, row["effect"] = field.effect, row["live"] = field.isLive;
  row["type"] = std::visit([&](auto member) { return typeOf(standard.*member); }, field.member);
  row["default"] = std::visit([&](auto member) { return toPython(standard.*member); }, field.member);
  const bool hasRange = field.allowed != NumberRange{};
  row["low"] = hasRange ? py::object(py::float_(field.allowed.low)) : py::none();
  row["high"] = hasRange ? py::object(py::float_(field.allowed.high)) : py::none();
  row["choices"] = namesIn(field.choices);
  row["only_with"] = namesIn(field.onlyWith);
  row["standard"] = field.standard;
  return row;
}
py::list listFields() {
  py::list list;
  py::dict integrator;
  integrator["key"] = kIntegrator, integrator["unit"] = "", integrator["live"] = false;
  integrator["type"] = "str";
  integrator["effect"] = "How a step finds the new velocities.";
  integrator["default"] = kIntegratorNames[0], integrator["low"] = py::none(),
  integrator["high"] = py::none();
  integrator["choices"] = std::vector<std::string>(std::begin(kIntegratorNames), std::end(kIntegratorNames));
  integrator["only_with"] = std::vector<std::string>{}, integrator["standard"] = "";
  list.append(integrator);
  for (const auto& field : settingsFields()) list.append(describeField(field));
  for (const auto& field : contactFields()) list.append(describeField(field));
  for (const auto& field : airFields()) list.append(describeField(field));
  for (const auto& field : goalFields()) list.append(describeField(field));
  return list;
}

template <class Owner>
std::string docOf(const SettingField<Owner>& field) {
  std::string doc = field.effect;
  if (field.allowed != NumberRange{})
    doc += fmt::format(" From {} to {}{}{}.", field.allowed.low, field.allowed.high, *field.unit ? " " : "",
                       field.unit);
  if (!field.choices.empty()) doc += fmt::format(" One of {}.", field.choices);
  if (!field.onlyWith.empty()) doc += fmt::format(" Only with {}.", field.onlyWith);
  if (*field.standard) doc += fmt::format(" None, the default: {}.", field.standard);
  return doc + (field.isLive ? " May change while hair moves." : "");
}

std::string settingsReprOf(const Settings& self) {
  const Settings standard{};
  std::string changed;
  for (const std::string& key : settingKeys()) {
    const py::object value = *getKey(self, key);
    if (!value.equal(*getKey(standard, key)))
      changed += fmt::format("{}{}={}", changed.empty() ? "" : ", ", key, std::string(py::repr(value)));
  }
  return fmt::format("<ringlet.Settings: {}>", changed.empty() ? "the default" : changed);
}

template <class Owner>
bool areEqual(const Owner& a, const Owner& b) {
  return std::ranges::all_of(fieldsOf<Owner>(), [&](const SettingField<Owner>& field) {
    return std::visit([&](auto member) { return a.*member == b.*member; }, field.member);
  });
}
bool areAllEqual(const Settings& a, const Settings& b) {
  return a.integrator == b.integrator && areEqual(a, b) && areEqual(a.contacts, b.contacts) &&
         areEqual(a.air, b.air) && areEqual(a.goal, b.goal);
}

// An attribute a setting; names that there are not are told with the nearest.
template <class Owner>
void addAttributes(py::class_<Owner>& owner) {
  for (const SettingField<Owner>& field : fieldsOf<Owner>()) {
    const std::string key = field.key, name = fmt::format("{}{}", kTable<Owner>, key);
    owner.def_property(field.key, py::cpp_function([key](const Owner& self) { return *getField(self, key); }),
                       py::cpp_function([key, name](Owner& self, const py::object& value) {
                         setField(self, key, name, value);
                       }),
                       docOf(field).c_str());
  }
  owner
      .def(
          "__getattr__",
          [](const py::object&, const std::string& name) -> py::object {
            throw py::attribute_error(unknownName("setting", name, keysOf<Owner>("")));
          },
          py::arg("name"), "AttributeError with the nearest name: asked only for what there is not.")
      .def(
          "__setattr__",
          [](const py::object& self, const py::str& name, const py::object& value) {
            if (!py::hasattr(py::type::of(self), name))
              throw py::attribute_error(unknownName("setting", std::string(name), keysOf<Owner>("")));
            if (PyObject_GenericSetAttr(self.ptr(), name.ptr(), value.ptr()) != 0)
              throw py::error_already_set();
          },
          py::arg("name"), py::arg("value"), "AttributeError for a name that there is not.")
      .def(
          "__eq__",
          [](const Owner& self, const py::object& other) {
            if (!py::isinstance<Owner>(other)) return false;
            if constexpr (std::is_same_v<Owner, Settings>)
              return areAllEqual(self, other.cast<const Settings&>());
            else
              return areEqual(self, other.cast<const Owner&>());
          },
          py::arg("other"), "Whether all settings are the same.")
      .def(
          "copy", [](const Owner& self) { return self; }, "Others with the same values.")
      .def(
          "__copy__", [](const Owner& self) { return self; }, "As copy.")
      .def(
          "__deepcopy__", [](const Owner& self, const py::object&) { return self; }, py::arg("memo"),
          "As copy.");
  owner.attr("__hash__") = py::none();  // they change
}

template <class Owner>
void addTable(py::module_& module, const char* name, const char* doc) {
  py::class_<Owner> table(module, name, doc);
  table
      .def(py::init([](const py::kwargs& named) {
             Owner made;
             setTable(made, py::object(named), kTable<Owner>);
             return made;
           }),
           "The default, but for these by name. TypeError for a name that there is not, ValueError for a "
           "number out of its range.")
      .def(
          "__repr__",
          [name = std::string(name)](const Owner& self) {
            const Owner standard{};
            std::string changed;
            for (const SettingField<Owner>& field : fieldsOf<Owner>()) {
              const py::object value = *getField(self, field.key);
              if (!value.equal(*getField(standard, field.key)))
                changed += fmt::format("{}{}={}", changed.empty() ? "" : ", ", field.key,
                                       std::string(py::repr(value)));
            }
            return fmt::format("<ringlet.{}: {}>", name, changed.empty() ? "the default" : changed);
          },
          "The settings that are not the default.");
  addAttributes(table);
}

using SettingsClass = py::class_<Settings>;

// What is not a plain number.
void addSettingsGroups(SettingsClass& settings) {
  settings
      .def_property(
          "integrator",
          [](const Settings& self) { return kIntegratorNames[static_cast<int>(self.integrator)]; },
          [](Settings& self, const py::object& word) { setKey(self, std::string(kIntegrator), word); },
          "How a step finds the new velocities: \"jacobi\", \"point_jacobi\" or \"paper\".")
      .def_property(
          "contacts", [](Settings& self) -> ContactSettings& { return self.contacts; },
          [](Settings& self, const py::object& value) { setTable(self.contacts, value, kContacts); },
          py::return_value_policy::reference_internal,
          "Whether and how hairs meet: ContactSettings, part of these settings. Takes others, or a dict.")
      .def_property(
          "air", [](Settings& self) -> AirSettings& { return self.air; },
          [](Settings& self, const py::object& value) { setTable(self.air, value, kAir); },
          py::return_value_policy::reference_internal,
          "The air hair moves in: AirSettings, part of these settings. Takes others, or a dict.")
      .def_property(
          "goal", [](Settings& self) -> GoalSettings& { return self.goal; },
          [](Settings& self, const py::object& value) { setTable(self.goal, value, kGoal); },
          py::return_value_policy::reference_internal,
          "Whether and how hair is pulled to the groom: GoalSettings, part of these settings. Takes others, "
          "or a dict.");
}

// Every setting by name.
void addSettingsKeys(SettingsClass& settings) {
  settings.def_property_readonly("step_seconds", &Settings::stepSeconds, "How long a step is [s].")
      .def_static(
          "fields", &listFields,
          "Every setting: a list of dicts of key, unit, effect, type, default, low and high (None: no "
          "range), choices (words), only_with (the integrators or tapers that have it), standard (what holds "
          "where it is None, in words), live (may change while hair moves).")
      .def(
          "keys", [](const py::object&) { return settingKeys(); }, "The names of all settings: a list.")
      .def(
          "__getitem__",
          [](const Settings& self, const std::string& key) {
            const auto value = getKey(self, key);
            if (!value) throw py::key_error(unknownSetting(key));
            return *value;
          },
          py::arg("key"), "A setting by name. KeyError for one that there is not.")
      .def(
          "__setitem__",
          [](Settings& self, const std::string& key, const py::object& value) {
            if (!setKey(self, key, value)) throw py::key_error(unknownSetting(key));
          },
          py::arg("key"), py::arg("value"),
          "KeyError for a name that there is not, ValueError for a number out of its range.")
      .def(
          "__contains__",
          [](const Settings& self, const std::string& key) { return getKey(self, key).has_value(); },
          py::arg("key"), "Whether there is such a setting.")
      .def("__repr__", &settingsReprOf, "The settings that are not the default.");
}

void addSettingsClass(py::module_& module) {
  SettingsClass settings(
      module, "Settings",
      "How hair is stepped: settings by name, as `settings.gravity`, `settings.contacts.friction` or "
      "`settings[\"contacts.friction\"]`. Settings.fields() lists all with units and ranges.");
  settings.def(py::init([](const py::kwargs& named) {
                 Settings made;
                 setAll(made, named);
                 return made;
               }),
               "The default, but for these by name; contacts, air and goal take a dict: "
               "Settings(steps_per_frame=4, air={\"on\": True}). TypeError for a name that there is not, "
               "ValueError for a number out of its range.");
  addSettingsGroups(settings);
  addSettingsKeys(settings);
  addAttributes(settings);
}

}  // namespace

void setAll(Settings& settings, const py::kwargs& named) {
  Settings changed = settings;
  for (const auto& [key, entry] : named) {
    const auto name = key.cast<std::string>();
    const auto value = py::reinterpret_borrow<py::object>(entry);
    if (name == "contacts") {
      setTable(changed.contacts, value, kContacts);
    } else if (name == "air") {
      setTable(changed.air, value, kAir);
    } else if (name == "goal") {
      setTable(changed.goal, value, kGoal);
    } else if (!setKey(changed, name, value)) {
      throw py::type_error(unknownSetting(name));
    }
  }
  settings = changed;
}

void addSettings(py::module_& module) {
  addTable<ContactSettings>(module, "ContactSettings",
                            "Whether and how hairs meet, as settings.contacts. Integrator jacobi only.");
  addTable<AirSettings>(module, "AirSettings",
                        "The air hair moves in, as settings.air. Integrator jacobi only.");
  addTable<GoalSettings>(
      module, "GoalSettings",
      "Whether and how hair is pulled to the groom, as settings.goal. Integrator jacobi only.");
  addSettingsClass(module);
}

}  // namespace ringlet::python
