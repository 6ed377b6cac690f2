// Values by name into what rows describe (scene/setting_field.h), for c/ringlet.h.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "ringlet/base/nearest_name.h"
#include "ringlet/base/vec3.h"
#include "ringlet/c/handles.h"
#include "ringlet/scene/setting_field.h"

namespace ringlet::c {

inline Outcome unknown(std::string_view what, std::string_view name, const std::vector<std::string>& names) {
  const std::size_t nearest = nearestName(name, names);
  return Outcome::invalid(
      fmt::format("there is no {} '{}'{}", what, name,
                  nearest < names.size() ? "; did you mean " + names[nearest] + "?" : ""));
}

template <class Fields>
void addNames(std::vector<std::string>& names, std::string_view table, const Fields& fields) {
  for (const auto& field : fields) names.push_back(fmt::format("{}{}", table, field.key));
}
inline bool isWhole(double value) { return value == std::floor(value) && std::abs(value) < 2147483648.0; }

// A value into a setting: nothing where the setting is of another type.
inline bool put(double& to, double value) { return to = value, true; }
inline bool put(std::optional<double>& to, double value) { return to = value, true; }
inline bool put(int& to, double value) { return isWhole(value) && (to = static_cast<int>(value), true); }
inline bool put(std::optional<int>& to, double value) {
  return isWhole(value) && (to = static_cast<int>(value), true);
}
inline bool put(std::uint32_t& to, double value) {
  const bool fits = value == std::floor(value) && value >= 0 && value <= 4294967295.0;
  return fits && (to = static_cast<std::uint32_t>(value), true);
}
inline bool put(bool& to, double value) { return (value == 0 || value == 1) && (to = value == 1, true); }
inline bool put(Vec3d& to, Vec3d value) { return to = value, true; }
bool put(auto&, double) { return false; }
bool put(auto&, Vec3d) { return false; }

// Numbers by their names into `owner`, which messages call `name`, and its numbers "number of a `kind`".
template <class Owner>
Outcome takeNumbers(std::span<const SettingField<Owner>> rows, const char* kind, const std::string& name,
                    const ringlet_number* numbers, std::uint32_t count, Owner& owner) {
  if (count > 0 && !numbers)
    return Outcome::invalid(fmt::format("{} has {} numbers, which are NULL", name, count));
  for (const ringlet_number& number : std::span(numbers, count)) {
    const std::string_view key = number.name ? number.name : "";
    const SettingField<Owner>* row = fieldNamed(rows, key);
    if (!row) {
      std::vector<std::string> names;
      addNames(names, "", rows);
      return unknown(fmt::format("number of a {}", kind), key, names);
    }
    const Vec3d vector{number.value[0], number.value[1], number.value[2]};
    const auto putInto = [&](auto member) {
      return put(owner.*member, vector.x) || put(owner.*member, vector);
    };
    if (!std::visit(putInto, row->member))
      return Outcome::invalid(fmt::format("{}: {} does not take {}", name, key, vector.x));
  }
  return {};
}

}  // namespace ringlet::c
