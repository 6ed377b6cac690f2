// Which preset a groom looks most like, from how its strands curl.
#pragma once

#include <string>

#include "ringlet/measure/groom_inspection.h"

namespace ringlet {

struct MaterialSuggestion {
  std::string preset;    // one of presetNames()
  std::string reason;    // what was found, half a sentence: "98 of 98 strands are curled, 24 turns, ..."
  bool isClear = false;  // no other preset is near: four of five strands are of the kind, and no width or
                         // length is within a fifth of what tells it from another
};

/// Widths of curls that tell the presets apart, of the median strand: as wide as a stick of chalk or more is
/// a loose curl, narrower than a pencil and a half a coil [m]. So is a curl this many times as long as its
/// chord, however wide. Ours.
inline constexpr double kLooseCurlWidth = 0.025, kCoilWidth = 0.012, kCoilArcOverChord = 4;
/// Strands without a curl that are longer than this many times their chord are wavy [1].
inline constexpr double kWavyArcOverChord = 1.1;

MaterialSuggestion suggestMaterial(const GroomShape& groom, double metresPerUnit);

}  // namespace ringlet
