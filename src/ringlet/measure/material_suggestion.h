// Suggests the preset closest to a groom, from the curl of its strands.
#pragma once

#include <string>

#include "ringlet/measure/groom_inspection.h"

namespace ringlet {

struct MaterialSuggestion {
  std::string preset;    // one of presetNames()
  std::string reason;    // the reason, half a sentence: "98 of 98 strands are curled, 24 turns, ..."
  bool isClear = false;  // no other preset is near: four of five strands are of the kind, and no width or
                         // length is within a fifth of the limit to another preset
};

/// Limits between presets, for the median strand's curl: a wider curl (about a stick of chalk) is a loose
/// curl, a narrower one (about one and a half pencils) a coil [m]. A curl that is this many times as long as
/// its chord is a coil too, whatever its width. Our own choice.
inline constexpr double kLooseCurlWidth = 0.025, kCoilWidth = 0.012, kCoilArcOverChord = 4;
/// Strands without a curl are wavy if they are longer than this many times their chord [1].
inline constexpr double kWavyArcOverChord = 1.1;

MaterialSuggestion suggestMaterial(const GroomShape& groom, double metresPerUnit);

}  // namespace ringlet
