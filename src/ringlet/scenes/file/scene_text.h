// The keys of a scene file in words, for messages, files and lists.
#pragma once

#include <string>
#include <type_traits>

#include "ringlet/scenes/file/scene_fields.h"

namespace ringlet {

/// What a value must be, without its range: "number", "[x, y, z]", "one of Y, Z".
template <class Owner>
std::string typeOf(const SceneField<Owner>& field);

/// "from 0 to 1 m"; "" if there is no range.
std::string rangeOf(const NumberRange& allowed, const char* unit);

/// Both, for a message: "a number from 0 to 1 m".
template <class Owner>
std::string expectedOf(const SceneField<Owner>& field);

// Below.

template <class Owner>
std::string typeOf(const SceneField<Owner>& field) {
  return std::visit(
      [&](auto member) -> std::string {
        using Value = std::remove_cvref_t<decltype(std::declval<Owner&>().*member)>;
        if constexpr (std::is_same_v<Value, double> || std::is_same_v<Value, std::optional<double>>)
          return "number";
        if constexpr (std::is_same_v<Value, int> || std::is_same_v<Value, std::optional<int>> ||
                      std::is_same_v<Value, std::uint32_t>)
          return "whole number";
        if constexpr (std::is_same_v<Value, bool>) return "true or false";
        if constexpr (std::is_same_v<Value, std::filesystem::path>) return "path";
        if constexpr (std::is_same_v<Value, Vec3d> || std::is_same_v<Value, std::optional<Vec3d>>)
          return "[x, y, z]";
        if constexpr (std::is_same_v<Value, std::optional<Quatd>>) return "[x, y, z, w]";
        if constexpr (std::is_same_v<Value, std::vector<std::string>>) return "list of " + field.choices;
        return field.choices.empty() ? "text" : "one of " + field.choices;
      },
      field.member);
}

template <class Owner>
std::string expectedOf(const SceneField<Owner>& field) {
  const std::string type = typeOf(field), range = rangeOf(field.allowed, field.unit);
  const bool isNumber = type.ends_with("number");
  std::string text = isNumber || type == "path" || type == "text" || type.starts_with("list") ? "a " : "";
  text += type;
  if (type.starts_with("[")) text += range.empty() ? "" : ", each";
  return range.empty() ? text : text + " " + range;
}

}  // namespace ringlet
