// Materials by name, for artists to start from. Dials adjust them: rest/material_dials.h.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ringlet/rest/material.h"

namespace ringlet {

/// straight, wavy, loose_curl, ringlet, coil: from straight hair to the tightest curls.
std::vector<std::string> presetNames();

/// None for a name that is not in presetNames().
std::optional<Material> materialPreset(std::string_view name);

/// What it looks like, in a sentence or two; empty for an unknown name.
std::string presetSummary(std::string_view name);

}  // namespace ringlet
