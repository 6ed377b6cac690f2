// Implements rest/material_presets.h.
#include "ringlet/rest/material_presets.h"

#include <span>

namespace ringlet {
namespace {

struct Preset {
  const char* name;
  const char* summary;
  Material material;
};

// Chosen such that the hanging curl (radius 1 cm, 8 turns, 25 cm, no preload) bounces at the frequency named,
// and that neither core nor bending needs more than 4 steps per 24 Hz frame: T sqrt(K / lambda) / alpha <= 3
// for 2 to 24 turns on 25 cm. Bend stiffness stays above 2 w: below it, a preloaded groom is bent by more
// than 27 degrees where it lies across gravity.
std::span<const Preset> presets() {
  static const Preset all[] = {
      {"straight",
       "Long smooth hair that swings in sheets and settles quickly. Hardly bounces along its length.",
       {.stretchStiffness = 200, .bendStiffness = 3, .bendDampingRatio = 0.3, .coreStiffness = 5}},
      {"wavy",
       "Soft waves that sway more than they bounce and come to rest after two or three swings.",
       {.bendStiffness = 3, .bendDampingRatio = 0.2, .coreStiffness = 8}},
      {"loose_curl",
       "Big soft curls that open and close with every move and swing on for a while, at a little below 4 Hz.",
       {.bendStiffness = 2, .bendDampingRatio = 0.15, .coreStiffness = 10}},
      {"ringlet",
       "Springy, well drawn corkscrews: they lengthen under a jolt and come back with a lively bounce of 4 "
       "to 5 Hz.",
       {.bendStiffness = 5, .bendDampingRatio = 0.15, .coreStiffness = 10}},
      {"coil",
       "Tight firm coils that keep their shape and move as a body, with a short quick bounce of about 5 Hz.",
       {.bendStiffness = 10, .bendDampingRatio = 0.15, .coreStiffness = 10}},
  };
  return all;
}

const Preset* presetOf(std::string_view name) {
  for (const Preset& preset : presets()) {
    if (preset.name == name) return &preset;
  }
  return nullptr;
}

}  // namespace

std::vector<std::string> presetNames() {
  std::vector<std::string> names;
  for (const Preset& preset : presets()) names.push_back(preset.name);
  return names;
}

std::optional<Material> materialPreset(std::string_view name) {
  const Preset* preset = presetOf(name);
  return preset ? std::optional(preset->material) : std::nullopt;
}

std::string presetSummary(std::string_view name) {
  const Preset* preset = presetOf(name);
  return preset ? preset->summary : "";
}

}  // namespace ringlet
