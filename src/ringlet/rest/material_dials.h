// Dials: adjustments that an artist makes to any material. They are applied to the material's numbers.
#pragma once

#include <optional>
#include <string>

#include "ringlet/rest/material.h"

namespace ringlet {

/// Factors; 1 has no effect. `wet` is no factor: 0 is dry, 1 soaked. Ranges and effects in words:
/// dialParameters() in rest/material_parameters.h.
struct MaterialDials {
  double hold = 1;        // on bend stiffness, with unchanged damping: how firmly the groom is kept
  double bounce = 1;      // on the inertial force of a head that travels: how far hair swings and bounces
  double springBack = 1;  // on the damping ratios of bend and core: how fast hair settles
  double curlKeep = 1;    // on core stiffness: how much a curl resists unwinding
  double weight = 1;      // on gravity: how far hair sags
  double rootHold = 1;    // on bend stiffness at the root, fading to 1 at half the strand
  double tipHold = 1;     // on bend stiffness at the tip, from 1 at half the strand
  double wet = 0;         // 0..1
  bool operator==(const MaterialDials&) const = default;
};

/// Dials do not lower the bend damping ratio below this: lower, bending can feed on itself.
inline constexpr double kLeastBendDampingRatio = 0.1;

/// The effect of soaking: keratin's modulus falls to 0.4 of dry (Robbins, Chemical and Physical Behavior of
/// Human Hair, chapter 9); the factors for the water's weight, and for hair that sticks to hair, are our own
/// choice.
inline constexpr double kWetStiffness = 0.4, kWetDamping = 2, kWetWeight = 1.5;

/// Applies the dials to a material. At the same damping ratio, stiffer bending would also settle faster, so
/// `hold` divides the ratio by its square root. The ratio is not lowered below kLeastBendDampingRatio;
/// returns a sentence if `springBack` asks for less. A material that is below already is not raised, but not
/// lowered further either.
[[nodiscard]] std::optional<std::string> applyDials(const MaterialDials& dials, Material& material);

}  // namespace ringlet
