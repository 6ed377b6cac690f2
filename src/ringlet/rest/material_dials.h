// Dials: what an artist turns on top of any material. Each is worked into the material's numbers.
#pragma once

#include <optional>
#include <string>

#include "ringlet/rest/material.h"

namespace ringlet {

/// Factors on what hair does; 1 leaves it as it is. `wet` is no factor: 0 is dry, 1 soaked. Ranges and
/// effects in words: dialParameters() in rest/material_parameters.h.
struct MaterialDials {
  double hold = 1;        // on bend stiffness, with as much damping: how firmly the groom is kept
  double bounce = 1;      // on the inertial force of a head that travels: how far hair swings and bounces
  double springBack = 1;  // on the damping ratios of bend and core: how fast hair settles
  double curlKeep = 1;    // on core stiffness: how much a curl resists unwinding
  double weight = 1;      // on gravity: how far hair sags
  double rootHold = 1;    // on bend stiffness at the root, fading to 1 at half the strand
  double tipHold = 1;     // on bend stiffness at the tip, from 1 at half the strand
  double wet = 0;         // 0..1
  bool operator==(const MaterialDials&) const = default;
};

/// The least bend damping ratio dials go down to: below it bending can feed on itself.
inline constexpr double kLeastBendDampingRatio = 0.1;

/// What water does to hair that is soaked: keratin's modulus falls to 0.4 of dry (Robbins, Chemical and
/// Physical Behavior of Human Hair, chapter 9); the water's weight, and that of hair that sticks to hair, are
/// ours.
inline constexpr double kWetStiffness = 0.4, kWetDamping = 2, kWetWeight = 1.5;

/// Works the dials into a material. Harder bending at the same damping ratio would also settle faster, so
/// `hold` divides the ratio by its root. The ratio goes no lower than kLeastBendDampingRatio; returns a
/// sentence where `springBack` asks for less. A material that is below by itself is never raised, only not
/// lowered further.
[[nodiscard]] std::optional<std::string> applyDials(const MaterialDials& dials, Material& material);

}  // namespace ringlet
