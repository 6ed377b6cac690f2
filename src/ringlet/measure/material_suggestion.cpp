// Implements measure/material_suggestion.h.
#include "ringlet/measure/material_suggestion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace ringlet {

namespace {

constexpr double kClearShare = 0.8, kNearShare = 0.2;

bool isAwayFrom(double value, double bound) { return std::abs(value - bound) > kNearShare * bound; }

}  // namespace

MaterialSuggestion suggestMaterial(const GroomShape& groom, double metresPerUnit) {
  const double arcOverChord = groom.arcOverChord.median;
  const auto shareOf = [&](std::size_t count) {
    return static_cast<double>(count) / static_cast<double>(std::max<std::size_t>(1, groom.strandCount));
  };
  if (2 * groom.curledCount < groom.strandCount) {
    return {
        arcOverChord > kWavyArcOverChord ? "wavy" : "straight",
        fmt::format(
            "{} of {} strands are curled, and strands are {:.2f} times as long as the way from root to tip",
            groom.curledCount, groom.strandCount, arcOverChord),
        shareOf(groom.strandCount - groom.curledCount) >= kClearShare &&
            isAwayFrom(arcOverChord - 1, kWavyArcOverChord - 1)};
  }
  const double width = 2 * groom.radius.median * metresPerUnit;
  const char* preset = width < kCoilWidth || arcOverChord > kCoilArcOverChord ? "coil"
                       : width < kLooseCurlWidth                              ? "ringlet"
                                                                              : "loose_curl";
  return {
      preset,
      fmt::format(
          "{} of {} strands are curled, with {:.1f} turns {:.1f} mm wide, and are {:.1f} times as long as "
          "the way from root to tip",
          groom.curledCount, groom.strandCount, groom.turns.median, 1000 * width, arcOverChord),
      shareOf(groom.curledCount) >= kClearShare && isAwayFrom(width, kCoilWidth) &&
          isAwayFrom(width, kLooseCurlWidth) && isAwayFrom(arcOverChord, kCoilArcOverChord)};
}

}  // namespace ringlet
