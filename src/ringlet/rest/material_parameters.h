// Every number of a material, once: its key in a TOML file, its unit, what it does and what it may be. What
// reads, writes, lists and checks materials goes through these tables.
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

/// What a person needs to know of a parameter.
struct ParameterText {
  const char* key;
  const char* unit;
  const char* effect;   // one sentence
  NumberRange allowed;  // beyond it is refused
  NumberRange usual;    // beyond it works, but hardly as hair does
};

/// A number of an Owner: Material, MaterialVariation or MaterialDials.
template <class Owner>
struct Parameter : ParameterText {
  std::variant<double Owner::*, std::optional<double> Owner::*, std::uint32_t Owner::*> member;

  bool canBeUnset() const { return member.index() == 1; }  // then it is measured on the rest curl
  bool isWhole() const { return member.index() == 2; }
  std::optional<double> of(const Owner& owner) const {
    return std::visit([&](auto number) -> std::optional<double> { return owner.*number; }, member);
  }
  /// A value in the allowed range; nothing only where it can be unset.
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

/// A curve from root to tip; the ranges are those of its factors.
struct ProfileParameter : ParameterText {
  Profile Material::*member;
};

std::span<const Parameter<Material>> materialParameters();            // of the file itself
std::span<const Parameter<MaterialDials>> dialParameters();           // of its table [dials]
std::span<const Parameter<MaterialVariation>> variationParameters();  // of [variation]
std::span<const ProfileParameter> profileParameters();                // of [profile]

/// The sentence that says what is wrong with a material, if anything is. checkMaterial covers all tables but
/// [dials].
Status checkMaterial(const Material& material);
Status checkDials(const MaterialDials& dials);
Status checkProfile(const ProfileParameter& parameter, const Profile& profile);

/// The dials that are turned: "hold 2, bounce 0.5"; "" for none.
std::string dialsText(const MaterialDials& dials);

/// Numbers that are allowed but not usual, a sentence each.
std::vector<std::string> unusualNumbers(const Material& material, const MaterialDials& dials);

/// "from 0.001 to 1e+06 w", "" for a unit that says nothing.
std::string rangeText(const NumberRange& range, const char* unit);

}  // namespace ringlet
