// Whether what a table of settings describes is in its range.
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/scene/setting_field.h"

namespace ringlet {

/// What a setting holds, number by number, each with what comes behind its name.
using SettingNumbers = std::vector<std::pair<const char*, double>>;
SettingNumbers numbersOf(const auto&) { return {}; }
inline SettingNumbers numbersOf(double value) { return {{"", value}}; }
inline SettingNumbers numbersOf(int value) { return {{"", double(value)}}; }
inline SettingNumbers numbersOf(std::uint32_t value) { return {{"", double(value)}}; }
inline SettingNumbers numbersOf(Vec3d v) { return {{".x", v.x}, {".y", v.y}, {".z", v.z}}; }
template <class T>
SettingNumbers numbersOf(const std::optional<T>& value) {
  return value ? numbersOf(*value) : SettingNumbers{};
}

/// The sentence that says which number is out of its range, if any is; `owner` stands before its key.
template <class Owner>
Status checkRows(std::span<const SettingField<Owner>> fields, const Owner& settings,
                 const std::string& owner) {
  for (const SettingField<Owner>& field : fields) {
    const SettingNumbers numbers =
        std::visit([&](auto member) { return numbersOf(settings.*member); }, field.member);
    for (const auto& [part, value] : numbers) {
      if (!field.allowed.contains(value))
        return Error{fmt::format("{}{}{} is {}; it must be from {} to {}", owner, field.key, part, value,
                                 field.allowed.low, field.allowed.high)};
    }
  }
  return {};
}

}  // namespace ringlet
