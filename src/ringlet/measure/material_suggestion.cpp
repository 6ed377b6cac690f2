// Implements measure/material_suggestion.h.
#include "ringlet/measure/material_suggestion.h"

#include <fmt/format.h>

namespace ringlet {

MaterialSuggestion suggestMaterial(const GroomInspection& groom, double metresPerUnit) {
  const double arcOverChord = groom.arcOverChord.median;
  if (2 * groom.curledCount < groom.strandCount) {
    return {
        arcOverChord > kWavyArcOverChord ? "wavy" : "straight",
        fmt::format("{} of {} strands are curled, and strands are {:.2f} times as long as the way from root "
                    "to tip",
                    groom.curledCount, groom.strandCount, arcOverChord)};
  }
  const double width = 2 * groom.radius.median * metresPerUnit;
  const char* preset = width < kCoilWidth || arcOverChord > kCoilArcOverChord ? "coil"
                       : width < kLooseCurlWidth                              ? "ringlet"
                                                                              : "loose_curl";
  return {preset,
          fmt::format("{} of {} strands are curled, with {:.1f} turns {:.1f} mm wide, and are {:.1f} "
                      "times as long as the way from root to tip",
                      groom.curledCount, groom.strandCount, groom.turns.median, 1000 * width, arcOverChord)};
}

}  // namespace ringlet
