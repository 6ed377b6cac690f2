// SettingField: the description of a setting: its member, name, type, unit, range, default and effect.
// Scene files, options, checks and lists go through tables of these (settings_fields.h,
// scenes/file/scene_fields.h).
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "ringlet/base/number_range.h"
#include "ringlet/base/vec3.h"
#include "ringlet/scene/contact_settings.h"

namespace ringlet {

enum class BodyShape;  // scene/body.h

template <class Owner>
using SettingMember =
    std::variant<double Owner::*, std::optional<double> Owner::*, int Owner::*, std::optional<int> Owner::*,
                 std::uint32_t Owner::*, bool Owner::*, std::string Owner::*, std::filesystem::path Owner::*,
                 Vec3d Owner::*, std::optional<Vec3d> Owner::*, std::optional<Quatd> Owner::*,
                 std::vector<std::string> Owner::*, ContactTaper Owner::*, ContactMethod Owner::*,
                 BodyShape Owner::*>;

/// One whose value is a part of an Owner: ContactSettings, AirSettings, a table of a scene file.
template <class Owner>
struct SettingField {
  const char* key;
  const char* unit;      // of numbers; "" for none
  const char* standard;  // the default in words; "" for the Owner's own default
  const char* effect;    // one sentence
  SettingMember<Owner> member;
  NumberRange allowed{};   // of a number, or of each of several
  std::string choices{};   // of a text or a list of texts, separated by commas; "" for any
  std::string onlyWith{};  // the kinds, shapes or sources that have it, separated by commas; "" for all
  bool isLive = false;     // may change while hair moves (Simulation::setSettings)

  SettingField live() const {
    SettingField changing = *this;
    changing.isLive = true;
    return changing;
  }

  /// The same setting of a type that has Owner as its base.
  template <class Derived>
  SettingField<Derived> of() const {
    const auto inherited = []<class T>(T Owner::*part) {
      return SettingMember<Derived>(static_cast<T Derived::*>(part));
    };
    return {key, unit, standard, effect, std::visit(inherited, member), allowed, choices, onlyWith, isLive};
  }
};

/// The one of a table that has this key; null for none.
template <class Owner>
const SettingField<Owner>* fieldNamed(std::span<const SettingField<Owner>> fields, std::string_view key) {
  for (const SettingField<Owner>& field : fields)
    if (field.key == key) return &field;
  return nullptr;
}

/// What a setting's member holds, or may hold.
template <class T>
struct Unwrapped {
  using Type = T;
};
template <class T>
struct Unwrapped<std::optional<T>> {
  using Type = T;
};

/// "a, b, c" as a list.
std::vector<std::string> namesIn(std::string_view list);

}  // namespace ringlet
