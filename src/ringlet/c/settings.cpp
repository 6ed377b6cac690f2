// Implements c/ringlet.h: settings and materials, by name.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <type_traits>

#include "ringlet/c/handles.h"
#include "ringlet/c/setting_values.h"
#include "ringlet/rest/material_parameters.h"
#include "ringlet/rest/material_presets.h"
#include "ringlet/scene/settings_fields.h"

namespace ringlet::c {
namespace {

constexpr std::string_view kContacts = "contacts.", kAir = "air.", kGoal = "goal.", kVariation = "variation.",
                           kIntegrator = "integrator";

std::vector<std::string> settingNames() {
  std::vector<std::string> names{std::string(kIntegrator)};
  addNames(names, "", settingsFields());
  addNames(names, kContacts, contactFields());
  addNames(names, kAir, airFields());
  addNames(names, kGoal, goalFields());
  return names;
}

// What a setting takes, and the function that sets it.
template <class T>
constexpr const char* kTakes = "a number: call ringlet_settings_set";
template <>
constexpr const char* kTakes<int> = "a whole number: call ringlet_settings_set";
template <>
constexpr const char* kTakes<std::uint32_t> = "a whole number from 0 on: call ringlet_settings_set";
template <>
constexpr const char* kTakes<bool> = "0 or 1: call ringlet_settings_set";
template <>
constexpr const char* kTakes<Vec3d> = "three numbers: call ringlet_settings_set_vector";
constexpr const char* kTakesWord = "a word: call ringlet_settings_set_text";

template <class Owner, class Put>
Outcome setField(std::span<const SettingField<Owner>> fields, std::string_view key, Owner& owner,
                 std::string_view name, const std::string& found, Put&& putInto) {
  const SettingField<Owner>* field = fieldNamed(fields, key);
  if (!field) return unknown("setting", name, settingNames());
  return std::visit(
      [&](auto member) -> Outcome {
        if (putInto(*field, owner.*member)) return {};
        using Value = typename Unwrapped<std::remove_cvref_t<decltype(owner.*member)>>::Type;
        return Outcome::invalid(fmt::format("the setting {} does not take {}; it takes {}", name, found,
                                            std::is_enum_v<Value> ? kTakesWord : kTakes<Value>));
      },
      field->member);
}

// Calls putInto(field, member) for the setting of this name.
template <class Put>
Outcome setNamed(Settings& settings, std::string_view name, const std::string& found, Put&& putInto) {
  if (name == kIntegrator)
    return Outcome::invalid(
        fmt::format("the setting {} does not take {}; it takes {}", name, found, kTakesWord));
  if (name.starts_with(kContacts))
    return setField(contactFields(), name.substr(kContacts.size()), settings.contacts, name, found, putInto);
  if (name.starts_with(kAir))
    return setField(airFields(), name.substr(kAir.size()), settings.air, name, found, putInto);
  if (name.starts_with(kGoal))
    return setField(goalFields(), name.substr(kGoal.size()), settings.goal, name, found, putInto);
  return setField(settingsFields(), name, settings, name, found, putInto);
}

Outcome setWord(Settings& settings, std::string_view name, std::string_view word) {
  const auto indexIn = [&](const auto& names) {
    return static_cast<int>(std::ranges::find(names, word) - std::ranges::begin(names));
  };
  if (name == kIntegrator) {
    const auto index = static_cast<std::size_t>(indexIn(kIntegratorNames));
    if (index == std::size(kIntegratorNames))
      return unknown("integrator", word, {std::begin(kIntegratorNames), std::end(kIntegratorNames)});
    settings.integrator = static_cast<Integrator>(index);
    return {};
  }
  std::vector<std::string> words;
  const auto putWord = [&](const auto& field, auto& member) {
    using Value = std::remove_cvref_t<decltype(member)>;
    if constexpr (std::is_enum_v<Value>) {
      words = namesIn(field.choices);
      const int index = indexIn(words);
      if (index < static_cast<int>(words.size())) member = static_cast<Value>(index), words.clear();
      return true;
    } else {
      return false;
    }
  };
  Outcome outcome = setNamed(settings, name, "a word", putWord);
  return outcome.result == RINGLET_OK && !words.empty() ? unknown(name, word, words) : outcome;
}

Outcome unknownNumber(std::string_view name) {
  std::vector<std::string> names;
  addNames(names, "", materialParameters());
  addNames(names, kVariation, variationParameters());
  return unknown("number of a material", name, names);
}

template <class Owner>
Outcome setParameter(std::span<const Parameter<Owner>> parameters, std::string_view key, Owner& owner,
                     std::string_view name, double value) {
  const auto found =
      std::ranges::find(parameters, key, [](const auto& p) { return std::string_view(p.key); });
  if (found == parameters.end()) return unknownNumber(name);
  // A number without a whole value becomes none.
  if (found->isWhole() && !(found->allowed.contains(value) && value == std::floor(value)))
    return Outcome::invalid(
        fmt::format("{} is {}; it takes a whole number{}", name, value, " " + rangeText(found->allowed, "")));
  found->set(owner, value);
  return {};
}

}  // namespace
}  // namespace ringlet::c

using namespace ringlet;
using namespace ringlet::c;

ringlet_result ringlet_settings_create(ringlet_settings** settings) {
  return guarded([&]() -> Outcome {
    if (Outcome wrong = checkArguments("ringlet_settings_create has nowhere to put the settings",
                                       {given("settings", settings)});
        !wrong.isFine())
      return wrong;
    *settings = new ringlet_settings{};
    return {};
  });
}

ringlet_result ringlet_settings_set(ringlet_settings* settings, const char* name, double value) {
  return guarded([&]() -> Outcome {
    if (Outcome wrong = checkArguments("ringlet_settings_set takes settings and a name",
                                       {given("settings", settings), given("name", name)});
        !wrong.isFine())
      return wrong;
    return setNamed(settings->settings, name, fmt::format("the number {}", value),
                    [&](const auto&, auto& member) { return put(member, value); });
  });
}

ringlet_result ringlet_settings_set_vector(ringlet_settings* settings, const char* name, double x, double y,
                                           double z) {
  return guarded([&]() -> Outcome {
    if (Outcome wrong = checkArguments("ringlet_settings_set_vector takes settings and a name",
                                       {given("settings", settings), given("name", name)});
        !wrong.isFine())
      return wrong;
    return setNamed(settings->settings, name, "three numbers here", [&](const auto&, auto& member) {
      return put(member, Vec3d{x, y, z});
    });
  });
}

ringlet_result ringlet_settings_set_text(ringlet_settings* settings, const char* name, const char* value) {
  return guarded([&]() -> Outcome {
    if (Outcome wrong =
            checkArguments("ringlet_settings_set_text takes settings, a name and a word",
                           {given("settings", settings), given("name", name), given("value", value)});
        !wrong.isFine())
      return wrong;
    return setWord(settings->settings, name, value);
  });
}

void ringlet_settings_release(ringlet_settings* settings) { delete settings; }

ringlet_result ringlet_material_create(const char* preset, ringlet_material** material) {
  return guarded([&]() -> Outcome {
    if (Outcome wrong = checkArguments("ringlet_material_create has nowhere to put the material",
                                       {given("material", material)});
        !wrong.isFine())
      return wrong;
    Material made;
    if (preset && *preset) {
      const auto found = materialPreset(preset);
      if (!found) return unknown("material", preset, presetNames());
      made = *found;
    }
    *material = new ringlet_material{std::move(made)};
    return {};
  });
}

ringlet_result ringlet_material_set(ringlet_material* material, const char* name, double value) {
  return guarded([&]() -> Outcome {
    if (Outcome wrong = checkArguments("ringlet_material_set takes a material and a name",
                                       {given("material", material), given("name", name)});
        !wrong.isFine())
      return wrong;
    const std::string_view key = name;
    Material& m = material->material;
    if (key.starts_with(kVariation))
      return setParameter(variationParameters(), key.substr(kVariation.size()), m.variation, key, value);
    return setParameter(materialParameters(), key, m, key, value);
  });
}

void ringlet_material_release(ringlet_material* material) { delete material; }
