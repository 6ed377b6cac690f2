// Material: what a hair is made of, in continuum units, so that it means the same however finely a strand is
// cut. Stiffnesses are multiples of the strand's own weight w = lambda g S [N] (line density, standard
// gravity, rest arc length): a stiffness of 5 means "5 w", whatever the strand's length. The laws that turn
// them into constants per edge are in rest/edge_constants.h and, independently, in reference/.
#pragma once

#include <optional>

namespace ringlet {

inline constexpr double kStandardGravity = 9.81;  // [m/s^2], used for w even where the scene has no gravity

struct Material {
  double lineDensity =
      1e-5;  // lambda [kg/m]; cancels from the motion of free hair (everything scales with w)
  double stretchStiffness = 100;     // K_s [w]: resists lengthening along each edge
  double stretchDampingTime = 0.01;  // C_s / K_s [s]
  double bendStiffness = 5;          // K_b [w]: keeps the curl's shape; 0.5 is a soft curl
  double bendDampingRatio = 0.15;    // C_b / (S sqrt(K_b lambda)); below 0.1 bending can feed on itself
  double coreStiffness = 40;         // K_c [w]: keeps a curl from unwinding into a line
  double coreDampingRatio = 0.25;    // zeta in C_c = 4 zeta alpha_c sqrt(K_c lambda)
  double coreRelaxedShare = 0.25;   // the core's constants at rest length, as a share of those when elongated
  double coreElongationLow = 1.0;   // core elongation (current / rest length) at which it begins to stiffen
  double coreElongationHigh = 1.1;  // and at which it has its full constants
  std::optional<double>
      bendSmoothingLength;  // alpha_b [m]; unset: from the rest curl (method.md 4); 0: raw curve
  std::optional<double> coreSmoothingLength;  // alpha_c [m]; unset: as above
};

/// The constants of Integrator::paper, per edge, for particles of mass 1 (paper Fig. 2 and public
/// implementations).
struct PaperMaterial {
  double stretchStiffness = 5e5, stretchDamping = 4472;
  double bendStiffness = 3e4, bendDamping = 1.74e3;
  double coreStiffness = 1.5e4, coreDamping = 1000;
};

}  // namespace ringlet
