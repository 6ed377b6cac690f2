// What an artist starts from and turns: materials by name, and dials on top of any material.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ringlet/rest/material.h"
#include "ringlet/scene/settings.h"

namespace ringlet {

/// straight, wavy, loose_curl, ringlet, coil: from straight hair to the tightest curls.
std::vector<std::string> presetNames();

/// Nothing for a name that is none of presetNames().
std::optional<Material> materialPreset(std::string_view name);

/// What it looks like, in a sentence or two; empty for an unknown name.
std::string presetSummary(std::string_view name);

/// Factors on a material, 1 leaves it as it is; and how far hair may lengthen.
/// Ranges and effects in words: dialParameters() in rest/material_parameters.h.
struct MaterialDials {
  double hold = 1;        // on bend stiffness: how firmly the groom is kept
  double bounce = 0.1;    // allowed stretch: an edge may become 1 + bounce of its length in the groom
  double springBack = 1;  // on the damping ratios of bend and core: how fast hair settles
  double curlKeep = 1;    // on core stiffness: how much a curl resists unwinding
  bool operator==(const MaterialDials&) const = default;
};

/// The least bend damping ratio dials go down to: below it bending can feed on itself.
inline constexpr double kLeastBendDampingRatio = 0.1;

/// Works the dials into a material, and sets maxStretch. Returns a sentence where the bend damping asked for
/// was below kLeastBendDampingRatio and stays there; a material that is below by itself is never raised, only
/// not lowered further.
[[nodiscard]] std::optional<std::string> applyDials(const MaterialDials& dials, Material& material,
                                                    Settings& settings);

}  // namespace ringlet
