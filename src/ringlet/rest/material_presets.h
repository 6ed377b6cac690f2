// What an artist starts from: materials by name. What turns them: rest/material_dials.h.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ringlet/rest/material.h"

namespace ringlet {

/// straight, wavy, loose_curl, ringlet, coil: from straight hair to the tightest curls.
std::vector<std::string> presetNames();

/// Nothing for a name that is none of presetNames().
std::optional<Material> materialPreset(std::string_view name);

/// What it looks like, in a sentence or two; empty for an unknown name.
std::string presetSummary(std::string_view name);

}  // namespace ringlet
