// Values of settings to Python's and back, by the rows that describe them (scene/setting_field.h).
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "python/arrays.h"
#include "ringlet/scene/contact_settings.h"
#include "ringlet/scene/setting_field.h"

namespace ringlet::python {

// Values to Python's.
py::object toPython(const auto&) { return py::none(); }  // types that no setting of these tables has
inline py::object toPython(double value) { return py::float_(value); }
inline py::object toPython(int value) { return py::int_(value); }
inline py::object toPython(std::uint32_t value) { return py::int_(value); }
inline py::object toPython(bool value) { return py::bool_(value); }
inline py::object toPython(Vec3d v) { return py::make_tuple(v.x, v.y, v.z); }
template <class T>
py::object toPython(const std::optional<T>& value) {
  return value ? toPython(*value) : py::none();
}
inline py::object toPython(ContactTaper value) { return py::str(nameOf(value)); }
inline py::object toPython(ContactMethod value) { return py::str(nameOf(value)); }

template <class Field>
void demandRange(const Field& field, double number, const std::string& key) {
  if (field.allowed.contains(number)) return;
  throw py::value_error(fmt::format("{} must be from {} to {}{}{}, got {}", key, field.allowed.low,
                                    field.allowed.high, *field.unit ? " " : "", field.unit, number));
}

inline int wordIn(const py::object& value, const std::vector<std::string>& words, const std::string& key) {
  if (!py::isinstance<py::str>(value))
    throw py::type_error(fmt::format("{} takes a word, got {}", key, describe(value)));
  const auto word = value.cast<std::string>();
  const auto found = std::ranges::find(words, word);
  if (found == words.end()) throw py::value_error(unknownName(key, word, words));
  return static_cast<int>(found - words.begin());
}

// And back. Throws TypeError for another type, ValueError for what is out of range.
template <class Field, class T>
void fromPython(const Field& field, const std::string& key, const py::object& value, T& to) {
  if constexpr (std::is_same_v<T, bool>) {
    if (!PyBool_Check(value.ptr()))
      throw py::type_error(fmt::format("{} takes True or False, got {}", key, describe(value)));
    to = value.cast<bool>();
  } else if constexpr (std::is_same_v<T, Vec3d>) {
    const Vec3d vector = vectorOf(value, key);
    for (const double number : {vector.x, vector.y, vector.z}) demandRange(field, number, key);
    to = vector;
  } else if constexpr (std::is_same_v<T, double>) {
    const double number = numberOf(value, key);
    demandRange(field, number, key);
    to = number;
  } else if constexpr (std::is_integral_v<T>) {
    const long long number = wholeNumberOf(value, key);
    demandRange(field, static_cast<double>(number), key);
    to = static_cast<T>(number);
  } else if constexpr (std::is_enum_v<T>) {
    to = static_cast<T>(wordIn(value, namesIn(field.choices), key));
  }
}
template <class Field, class T>
void fromPython(const Field& field, const std::string& key, const py::object& value, std::optional<T>& to) {
  if (value.is_none()) {
    to.reset();
    return;
  }
  T set{};
  fromPython(field, key, value, set);
  to = set;
}

// Numbers of an Owner by name; `what` it is and `others`, names of what else it takes, are for messages.
// Throws TypeError for an unknown name.
template <class Owner>
void setNumbers(std::span<const SettingField<Owner>> rows, const char* what, std::vector<std::string> others,
                const py::kwargs& numbers, Owner& owner) {
  for (const auto& [key, value] : numbers) {
    const std::string name = py::str(key);
    const SettingField<Owner>* row = fieldNamed(rows, name);
    if (!row) {
      for (const SettingField<Owner>& each : rows) others.emplace_back(each.key);
      throw py::type_error(unknownName(fmt::format("number of a {}", what), name, others));
    }
    const py::object object = py::reinterpret_borrow<py::object>(value);
    std::visit([&, row = row](auto member) { fromPython(*row, name, object, owner.*member); }, row->member);
  }
}

// A line each: "core: Distance below which radial and around fade to 0. 0.02 [m]".
template <class Owner>
std::string numbersText(std::span<const SettingField<Owner>> rows) {
  const Owner standard{};
  std::string text;
  for (const SettingField<Owner>& row : rows) {
    const std::string unit = *row.unit ? fmt::format(" [{}]", row.unit) : "";
    const py::object value = std::visit([&](auto member) { return toPython(standard.*member); }, row.member);
    text += fmt::format("\n{}: {} {}{}", row.key, row.effect, py::repr(value).cast<std::string>(), unit);
  }
  return text;
}

}  // namespace ringlet::python
