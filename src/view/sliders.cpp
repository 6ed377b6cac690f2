// Implements view/sliders.h.
#include "view/sliders.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <type_traits>
#include <utility>
#include <variant>

#include "ringlet/rest/live_material.h"
#include "ringlet/rest/material_parameters.h"
#include "ringlet/scene/settings_fields.h"
#include "ringlet/scenes/file/scene_fields.h"
#include "ringlet/scenes/load/scene_parts.h"

namespace ringlet::view {
namespace {

constexpr double kDecades = 100;  // that a slider reaches to either side of the standard
constexpr double kMostEven = 20;  // a range so wide, or from 0 to 1, is shown evenly and whole

// What a slider shows of a range: all of a narrow one, else what is near the standard.
void chooseShown(Slider& slider) {
  const NumberRange& all = slider.allowed;
  const double standard = std::abs(slider.standard);
  slider.shown = all;
  if (all.high - all.low <= kMostEven) return;
  if (all.low < 0) {
    const double reach = std::max(kMostEven, 2 * standard);
    slider.shown = {std::max(all.low, -reach), std::min(all.high, reach)};
  } else if (slider.kind == Slider::Kind::whole) {
    slider.shown = {all.low, std::min(all.high, std::max(kMostEven, 4 * standard))};
  } else if (standard > 0) {
    slider.isLogarithmic = true;
    slider.shown = {std::max(all.low, standard / kDecades), std::min(all.high, standard * kDecades)};
  } else {
    slider.shown = {all.low, std::min(all.high, all.low + kMostEven)};
  }
}

// Another value that is allowed, to see what changes with it.
double otherThan(const Slider& slider, double value) {
  if (slider.kind == Slider::Kind::toggle) return 1 - value;
  if (slider.kind == Slider::Kind::choice) return value > 0 ? 0 : 1;
  if (slider.kind == Slider::Kind::whole) return value > slider.allowed.low ? value - 1 : value + 1;
  const double middle = (slider.shown.low + slider.shown.high) / 2;
  return middle == value ? slider.shown.high : middle;
}

// A change is live where nothing of hair that is built differs.
bool actsLive(const Slider& slider) {
  const SceneFile scene;
  const Edits before = editsOf(scene);
  Edits after = before;
  slider.set(after, 0, otherThan(slider, slider.get(before, 0).value_or(slider.standard)));
  const auto settings = [&](const Edits& edits) { return settingsOf(sceneWith(scene, edits)); };
  return fixedDifference(settings(before), settings(after)).empty() &&
         fixedDifference(before.materials[0].material, after.materials[0].material).empty();
}

Slider finished(Slider slider) {
  if (slider.shown == NumberRange{}) chooseShown(slider);
  slider.isLive = actsLive(slider);
  return slider;
}

// `entry`: of a table of settings or of materials' numbers.
template <class Entry>
Slider namedSlider(const char* table, const Entry& entry) {
  Slider slider;
  slider.name = fmt::format("{}.{}", table, entry.key);
  slider.table = table;
  slider.label = entry.key;
  slider.unit = std::string(entry.unit) == "1" ? "" : entry.unit;
  slider.effect = entry.effect;
  return slider;
}

// Not a temporary in a template, on which GCC 12 fails.
const Edits& unedited() {
  static const Edits edits;
  return edits;
}

// Of members that hold, or may hold, a number; a choice by its place; a vector's part.
template <class Owner>
class FieldSliders {
 public:
  FieldSliders(const char* table, Owner Edits::*part, std::vector<Slider>& sliders)
      : table_(table), part_(part), sliders_(sliders) {}

  void add(const SettingField<Owner>& field) {
    std::visit([&](auto member) { addMember(field, member); }, field.member);
  }

 private:
  static double& componentOf(Vec3d& v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }
  Slider named(const SettingField<Owner>& field) const {
    Slider slider = namedSlider(table_, field);
    slider.onlyWith = field.onlyWith;
    slider.allowed = field.allowed;
    return slider;
  }

  template <class Member>
  void addMember(const SettingField<Owner>& field, Member member) {
    using Held = std::remove_cvref_t<decltype(std::declval<Owner&>().*member)>;
    using Value = typename Unwrapped<Held>::Type;
    if constexpr (std::is_same_v<Value, Vec3d>) {
      if constexpr (std::is_same_v<Held, Vec3d>) addVector(field, member);
    } else if constexpr (std::is_arithmetic_v<Value>) {
      addNumber<Held>(field, member);
    } else if constexpr (std::is_enum_v<Value> || std::is_same_v<Value, std::string>) {
      addChoice<Held>(field, member);
    }
  }

  template <class Held>
  void addNumber(const SettingField<Owner>& field, Held Owner::*member) {
    using Value = typename Unwrapped<Held>::Type;
    Slider slider = named(field);
    slider.kind = std::is_same_v<Value, bool>     ? Slider::Kind::toggle
                  : std::is_same_v<Value, double> ? Slider::Kind::number
                                                  : Slider::Kind::whole;
    if (slider.kind == Slider::Kind::toggle) slider.allowed = {0, 1};
    const auto part = part_;
    slider.get = [part, member](const Edits& edits, std::size_t) -> std::optional<double> {
      const Held& held = (edits.*part).*member;
      if constexpr (std::is_same_v<Held, Value>) {
        return static_cast<double>(held);
      } else {
        return held ? std::optional<double>(static_cast<double>(*held)) : std::nullopt;
      }
    };
    slider.set = [part, member](Edits& edits, std::size_t, double value) {
      if constexpr (std::is_same_v<Value, bool>) {
        (edits.*part).*member = value > 0.5;
      } else if constexpr (std::is_same_v<Value, double>) {
        (edits.*part).*member = value;
      } else {
        (edits.*part).*member = static_cast<Value>(std::llround(value));
      }
    };
    const std::optional<double> known = slider.get(unedited(), 0);
    slider.standard = known.value_or(std::sqrt(std::max(slider.allowed.low, 1e-3) * slider.allowed.high));
    if (slider.kind == Slider::Kind::whole) slider.standard = std::round(slider.standard);
    sliders_.push_back(finished(std::move(slider)));
  }

  void addVector(const SettingField<Owner>& field, Vec3d Owner::*member) {
    for (int axis = 0; axis < 3; ++axis) {
      Slider slider = named(field);
      slider.name += fmt::format(".{}", "xyz"[axis]);
      slider.label += fmt::format(" {}", "xyz"[axis]);
      const auto part = part_;
      slider.get = [part, member, axis](const Edits& edits, std::size_t) -> std::optional<double> {
        Vec3d held = (edits.*part).*member;
        return componentOf(held, axis);
      };
      slider.set = [part, member, axis](Edits& edits, std::size_t, double value) {
        componentOf((edits.*part).*member, axis) = value;
      };
      sliders_.push_back(finished(std::move(slider)));
    }
  }

  template <class Value>
  void addChoice(const SettingField<Owner>& field, Value Owner::*member) {
    Slider slider = named(field);
    slider.kind = Slider::Kind::choice;
    slider.choices = namesIn(field.choices);
    slider.allowed = slider.shown = {0, static_cast<double>(slider.choices.size() - 1)};
    const std::vector<std::string> choices = slider.choices;
    const auto part = part_;
    slider.get = [part, member, choices](const Edits& edits, std::size_t) -> std::optional<double> {
      const auto& held = (edits.*part).*member;
      if constexpr (std::is_enum_v<Value>) {
        return static_cast<double>(held);
      } else {
        return static_cast<double>(std::ranges::find(choices, held) - choices.begin());
      }
    };
    slider.set = [part, member, choices](Edits& edits, std::size_t, double value) {
      auto& held = (edits.*part).*member;
      if constexpr (std::is_enum_v<Value>) {
        held = static_cast<Value>(std::llround(value));
      } else {
        held = choices[static_cast<std::size_t>(std::llround(value))];
      }
    };
    sliders_.push_back(finished(std::move(slider)));
  }

  const char* table_;
  Owner Edits::*part_;
  std::vector<Slider>& sliders_;
};

template <class Owner>
std::vector<Slider> slidersOf(const char* table, std::span<const SettingField<Owner>> fields,
                              Owner Edits::*part) {
  std::vector<Slider> sliders;
  FieldSliders<Owner> adding(table, part, sliders);
  for (const SettingField<Owner>& field : fields) adding.add(field);
  return sliders;
}

// `ownerOf`: the part of a material that has the numbers.
template <class Owner, class OwnerOf>
void addMaterial(const char* table, std::span<const Parameter<Owner>> parameters, OwnerOf ownerOf,
                 std::vector<Slider>& sliders) {
  for (const Parameter<Owner>& parameter : parameters) {
    Slider slider = namedSlider(table, parameter);
    slider.kind = parameter.isWhole() ? Slider::Kind::whole : Slider::Kind::number;
    slider.allowed = parameter.allowed;
    slider.shown = {std::max(parameter.usual.low, parameter.allowed.low),
                    std::min(parameter.usual.high, parameter.allowed.high)};
    slider.isLogarithmic = slider.shown.low > 0 && slider.shown.high / slider.shown.low > kMostEven;
    slider.standard = parameter.defaultValue().value_or(slider.shown.low);
    slider.get = [&parameter, ownerOf](const Edits& edits, std::size_t material) {
      EditedMaterial copy = edits.materials[material];
      return parameter.of(ownerOf(copy));
    };
    slider.set = [&parameter, ownerOf](Edits& edits, std::size_t material, double value) {
      parameter.set(ownerOf(edits.materials[material]), value);
    };
    sliders.push_back(finished(std::move(slider)));
  }
}

}  // namespace

std::vector<SliderGroup> sliderGroups() {
  std::vector<Slider> hair;
  addMaterial(
      "material.dials", dialParameters(), [](EditedMaterial& m) -> MaterialDials& { return m.dials; }, hair);
  addMaterial(
      "material", materialParameters(), [](EditedMaterial& m) -> Material& { return m.material; }, hair);
  addMaterial(
      "material.variation", variationParameters(),
      [](EditedMaterial& m) -> MaterialVariation& { return m.material.variation; }, hair);
  return {{"hair", std::move(hair)},
          {"air", slidersOf("air", airFields(), &Edits::air)},
          {"contacts", slidersOf("contacts", contactFields(), &Edits::contacts)},
          {"goal", slidersOf("goal", goalFields(), &Edits::goal)},
          {"run", slidersOf("simulation", simulationFields(), &Edits::simulation)}};
}

bool isInUse(const Slider& slider, const Edits& edits) {
  if (slider.onlyWith.empty()) return true;
  const std::vector<std::string> with = namesIn(slider.onlyWith);
  const std::string taper = edits.contacts.taper == ContactTaper::time ? "time" : "distance";
  const std::string& having = slider.name.starts_with("contacts.") ? taper : edits.simulation.integrator;
  return std::ranges::find(with, having) != with.end();
}

}  // namespace ringlet::view
