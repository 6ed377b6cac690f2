// All numbers of a material, each defined once: its key in a TOML file, its unit, its effect and its range.
// Everything that reads, writes, lists or checks materials uses these tables.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "ringlet/base/number_range.h"
#include "ringlet/base/result.h"
#include "ringlet/rest/material.h"
#include "ringlet/rest/material_dials.h"

namespace ringlet {

/// Description of a parameter for users.
struct ParameterText {
  const char* key;
  const char* unit;
  const char* effect;   // one sentence
  NumberRange allowed;  // other values are refused
  NumberRange usual;    // other values work, but hardly behave like hair
};

/// A number of an Owner: Material, MaterialVariation or MaterialDials.
template <class Owner>
struct Parameter : ParameterText {
  std::variant<double Owner::*, std::optional<double> Owner::*, std::uint32_t Owner::*> member;

  bool canBeUnset() const { return member.index() == 1; }  // unset: it is measured on the rest curl
  bool isWhole() const { return member.index() == 2; }
  std::optional<double> of(const Owner& owner) const {
    return std::visit([&](auto number) -> std::optional<double> { return owner.*number; }, member);
  }
  /// Sets a value in the allowed range; no value only if it can be unset.
  void set(Owner& owner, std::optional<double> value) const {
    std::visit(
        [&](auto number) {
          using Number = std::remove_reference_t<decltype(owner.*number)>;
          if constexpr (std::is_same_v<Number, std::optional<double>>) {
            owner.*number = value;
          } else {
            owner.*number = static_cast<Number>(value.value());
          }
        },
        member);
  }
  std::optional<double> defaultValue() const {
    static const Owner standard{};
    return of(standard);
  }
};

/// A profile from root to tip; the ranges are those of its factors.
struct ProfileParameter : ParameterText {
  Profile Material::*member;
};

std::span<const Parameter<Material>> materialParameters();            // of the file's top level
std::span<const Parameter<MaterialDials>> dialParameters();           // of its table [dials]
std::span<const Parameter<MaterialVariation>> variationParameters();  // of [variation]
std::span<const ProfileParameter> profileParameters();                // of [profile]

/// Fails with a sentence that says what is wrong. checkMaterial covers all tables except [dials].
Status checkMaterial(const Material& material);
Status checkDials(const MaterialDials& dials);
Status checkProfile(const ProfileParameter& parameter, const Profile& profile);

/// The dials that differ from the default: "hold 2, bounce 0.5"; "" for none.
std::string dialsText(const MaterialDials& dials);

/// Numbers that are allowed but unusual, a sentence each.
std::vector<std::string> unusualNumbers(const Material& material, const MaterialDials& dials);

/// "from 0.001 to 1e+06 w"; no unit if it is dimensionless.
std::string rangeText(const NumberRange& range, const char* unit);

}  // namespace ringlet
