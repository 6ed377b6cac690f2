// Sliders: every number of a scene that the window shows, made of the tables that scene files and options are
// made of (scene/settings_fields.h, scenes/file/scene_fields.h, rest/material_parameters.h).
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "ringlet/base/number_range.h"
#include "view/edits.h"

namespace ringlet::view {

struct Slider {
  enum class Kind { number, whole, toggle, choice };

  std::string name;      // of the key in a scene file: "air.wind.x", "material.dials.hold"
  std::string table;     // of the scene file that has it: "air", "material.dials"
  std::string label;     // without its table
  std::string unit;      // "" for none
  std::string effect;    // a sentence
  std::string onlyWith;  // the integrators or tapers that have it, separated by commas; "" for all
  Kind kind = Kind::number;
  NumberRange allowed{}, shown{};    // shown: what the slider reaches; typed numbers may be beyond it
  bool isLogarithmic = false;        // over what is shown
  std::vector<std::string> choices;  // of a choice, whose value is its number
  double standard = 0;               // where it is unset, and what it is set back to
  bool isLive = false;               // acts in the next frame; else the hair is built anew where it is

  /// None: unset. `material`: A is 0, B is 1.
  std::function<std::optional<double>(const Edits&, std::size_t material)> get;
  std::function<void(Edits&, std::size_t material, double)> set;
};

/// A tab of the window.
struct SliderGroup {
  std::string title;
  std::vector<Slider> sliders;
};
std::vector<SliderGroup> sliderGroups();

/// Whether a slider means something in a scene with these numbers (Slider::onlyWith).
bool isInUse(const Slider& slider, const Edits& edits);

}  // namespace ringlet::view
