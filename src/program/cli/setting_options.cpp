// Implements setting_options.h.
#include "program/cli/setting_options.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <type_traits>

#include "program/cli/command_line.h"
#include "ringlet/base/assert.h"
#include "ringlet/scenes/file/scene_file.h"

namespace ringlet::program {
namespace {

// What a member holds, or may hold.
template <class Owner, class Member>
using ValueOf =
    typename Unwrapped<std::remove_cvref_t<decltype(std::declval<Owner&>().*std::declval<Member>())>>::Type;

template <class Owner>
CLI::Validator validatorOf(const SettingField<Owner>& field) {
  return std::visit(
      [&](auto member) {
        using Value = ValueOf<Owner, decltype(member)>;
        if constexpr (std::is_same_v<Value, double>) return between(field.allowed.low, field.allowed.high);
        if constexpr (std::is_same_v<Value, bool>) return oneOf({"on", "off"});
        if constexpr (std::is_enum_v<Value> || std::is_same_v<Value, std::string>)
          return oneOf(namesIn(field.choices));
        return wholeBetween(static_cast<std::int64_t>(field.allowed.low),
                            static_cast<std::int64_t>(field.allowed.high));
      },
      field.member);
}

template <class Owner>
std::string typeNameOf(const SettingField<Owner>& field) {
  return std::visit(
      [&](auto member) -> std::string {
        using Value = ValueOf<Owner, decltype(member)>;
        if constexpr (std::is_same_v<Value, double>) return field.unit == std::string("m") ? "METRES" : "X";
        if constexpr (std::is_same_v<Value, bool>) return "on|off";
        if constexpr (std::is_enum_v<Value> || std::is_same_v<Value, std::string>) return "NAME";
        return "N";
      },
      field.member);
}

template <class Value>
Value parsed(const std::string& text, const std::string& choices) {
  if constexpr (std::is_same_v<Value, double>) {
    return std::strtod(text.c_str(), nullptr);
  } else if constexpr (std::is_same_v<Value, bool>) {
    return text == "on";
  } else if constexpr (std::is_same_v<Value, std::string>) {
    return text;
  } else if constexpr (std::is_enum_v<Value>) {
    const std::vector<std::string> names = namesIn(choices);
    return static_cast<Value>(std::ranges::find(names, text) - names.begin());
  } else if constexpr (std::is_integral_v<Value>) {
    Value value{};
    std::from_chars(text.data(), text.data() + text.size(), value);
    return value;
  } else {
    RINGLET_ASSERT(false, "a setting of this type has no option yet");
    return {};
  }
}

// "(from 0 to 1 m; default 0)" of a key in a scene file.
std::string rangeAndDefault(const char* table, const char* key) {
  const std::vector<SceneKey> keys = sceneKeys();
  const auto found = std::ranges::find_if(
      keys, [&](const SceneKey& k) { return k.table == std::string(table) && k.key == std::string(key); });
  RINGLET_ASSERT(found != keys.end(), "an option's setting is a key of scene files");
  const std::string range = found->range.empty() ? found->type : found->range;
  const std::string standard = found->standard == "true"    ? "on"
                               : found->standard == "false" ? "off"
                                                            : found->standard;
  return fmt::format("({}; default {})", range == "true or false" ? "on or off" : range, standard);
}

template <class Owner>
std::string helpOf(const SettingField<Owner>& field, const char* table) {
  std::string_view effect = field.effect;
  effect.remove_suffix(effect.ends_with('.') ? 1 : 0);
  return fmt::format("{} {}", effect, rangeAndDefault(table, field.key));
}

}  // namespace

template <class Owner>
void addSettingOptions(CLI::App* command, std::span<const SettingField<Owner>> fields, const char* table,
                       TypedSettings& typed, const char* group) {
  for (const SettingField<Owner>& field : fields) {
    if (!*field.option) continue;
    const auto keep = [&typed, key = std::string(field.key)](const std::string& text) { typed[key] = text; };
    command->add_option_function<std::string>(field.option, keep, helpOf(field, table))
        ->check(validatorOf(field))
        ->type_name(typeNameOf(field))
        ->group(group);
  }
}

template <class Owner>
void applySettingOptions(std::span<const SettingField<Owner>> fields, const TypedSettings& typed,
                         Owner& settings) {
  for (const SettingField<Owner>& field : fields) {
    const auto found = typed.find(field.key);
    if (found == typed.end()) continue;
    std::visit(
        [&](auto member) {
          using Value = ValueOf<Owner, decltype(member)>;
          settings.*member = parsed<Value>(found->second, field.choices);
        },
        field.member);
  }
}

template void addSettingOptions(CLI::App*, std::span<const SettingField<ContactSettings>>, const char*,
                                TypedSettings&, const char*);
template void applySettingOptions(std::span<const SettingField<ContactSettings>>, const TypedSettings&,
                                  ContactSettings&);
template void addSettingOptions(CLI::App*, std::span<const SettingField<HairCut>>, const char*,
                                TypedSettings&, const char*);
template void applySettingOptions(std::span<const SettingField<HairCut>>, const TypedSettings&, HairCut&);

}  // namespace ringlet::program
