// Material: the properties of hair, in continuum units, so that they do not depend on how finely a strand is
// divided into edges. Stiffnesses are multiples of the strand's own weight w = lambda g S [N] (line density,
// standard gravity, rest arc length): a stiffness of 5 means "5 w", whatever the strand's length.
// rest/strand_constants.h and, independently, reference/ turn them into constants per edge. For the effect
// and range of each number see rest/material_parameters.h.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <memory>
#include <optional>
#include <vector>

#include "ringlet/base/standard_gravity.h"
#include "ringlet/groom/seeded_random.h"

namespace ringlet {

/// A factor along a strand, from root to tip: linear between points, constant before the first and after the
/// last.
struct Profile {
  struct Point {
    double s = 0;  // share of the strand's rest arc length, 0 at the root, 1 at the tip
    double factor = 1;
    bool operator==(const Point&) const = default;
  };
  std::vector<Point> points{};  // with rising s; empty: 1 everywhere

  double at(double s) const {
    if (points.empty()) return 1;
    if (!(s > points.front().s)) return points.front().factor;
    for (std::size_t i = 1; i < points.size(); ++i) {
      const Point &a = points[i - 1], &b = points[i];
      if (s < b.s) return a.factor + (b.factor - a.factor) * ((s - a.s) / (b.s - a.s));
    }
    return points.back().factor;
  }
  /// Its largest and its smallest factor.
  double most() const {
    return extreme([](double a, double b) { return std::max(a, b); });
  }
  double least() const {
    return extreme([](double a, double b) { return std::min(a, b); });
  }
  bool operator==(const Profile&) const = default;

 private:
  template <class Of>
  double extreme(const Of& of) const {
    double found = at(0);
    for (const Point& point : points) found = of(found, point.factor);
    return found;
  }
};

/// How strands differ from one another: a strand's value is the material's times a factor drawn uniformly
/// from 1 - share to 1 + share, by the seed and the strand's index in groom order.
struct MaterialVariation {
  double bendStiffness = 0;     // share, 0 for none
  double coreStiffness = 0;     // share
  double bendDampingRatio = 0;  // share
  std::uint32_t seed = 1;
  bool operator==(const MaterialVariation&) const = default;
};

struct Material;

/// Range of a strand's factor.
inline constexpr double kLeastStrandFactor = 0.001, kMostStrandFactor = 1000;

/// Consecutive strands with one factor; indices in groom order, from 0.
struct StrandRun {
  std::uint32_t first = 0, last = 0;
  float factor = 1;
  bool operator==(const StrandRun&) const = default;
};

/// A factor on one number of a material, for some strands; the others have 1.
struct StrandFactors {
  double Material::*number = nullptr;
  std::shared_ptr<const std::vector<StrandRun>> runs{};  // not null; sorted, without overlaps

  double of(std::size_t strand) const {
    const auto next = std::upper_bound(runs->begin(), runs->end(), strand,
                                       [](std::size_t s, const StrandRun& run) { return s < run.first; });
    return next == runs->begin() || strand > std::prev(next)->last ? 1 : std::prev(next)->factor;
  }
  bool operator==(const StrandFactors& other) const {
    return number == other.number && (runs == other.runs || *runs == *other.runs);
  }
};

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
  double coreElongationHigh = 1.1;  // core elongation at which it has its full constants
  double gravityFactor = 1;         // multiplies gravity; the preload balances its share of gravity without
                                    // the factor
  double inertiaFactor = 1;  // multiplies the inertial force of a head that travels, not of one that turns
  std::optional<double> bendSmoothingLength{};  // alpha_b [m]; unset: from the rest curl; 0: raw curve
  std::optional<double> coreSmoothingLength{};  // alpha_c [m]; unset: as above

  // Along the strand. Damping that is given as a ratio scales with the square root of the stiffness.
  Profile bendStiffnessProfile{};        // on K_b
  Profile bendDampingRatioProfile{};     // on C_b, in addition to the effect of K_b
  Profile stretchStiffnessProfile{};     // on K_s
  Profile stretchDampingTimeProfile{};   // on C_s / K_s
  Profile coreStiffnessProfile{};        // on K_c
  Profile coreDampingRatioProfile{};     // on zeta
  Profile lineDensityProfile{};          // on lambda
  MaterialVariation variation{};         // from strand to strand
  std::vector<StrandFactors> factors{};  // also from strand to strand, from maps; factors on one number
                                         // multiply
  bool operator==(const Material&) const = default;

  /// Whether edges have other factors along the strand than that of the bend stiffness.
  bool hasEdgeProfiles() const {
    return !(bendDampingRatioProfile.points.empty() && stretchStiffnessProfile.points.empty() &&
             stretchDampingTimeProfile.points.empty() && coreStiffnessProfile.points.empty() &&
             coreDampingRatioProfile.points.empty());
  }
};

/// The material of one strand: the groom's, with the strand's variation and factors applied and removed.
/// strandIndex: in groom order. The same seed and index give the same strand, independently of other strands.
inline Material materialOfStrand(const Material& material, std::size_t strandIndex) {
  const MaterialVariation& variation = material.variation;
  // A random stream of its own: grooms draw from streams with small seeds too.
  constexpr std::uint64_t kStream = std::uint64_t{1} << 40;
  SeededRandom random(kStream + variation.seed, strandIndex);
  auto factor = [&](double share) { return 1 + share * random.between(-1, 1); };

  Material own = material;
  own.bendStiffness *= factor(variation.bendStiffness);
  own.coreStiffness *= factor(variation.coreStiffness);
  own.bendDampingRatio *= factor(variation.bendDampingRatio);
  own.variation = {};
  for (const StrandFactors& factors : material.factors) own.*factors.number *= factors.of(strandIndex);
  own.factors.clear();
  return own;
}

/// The constants of Integrator::paper, per edge, for particles of mass 1 (paper Fig. 2 and public
/// implementations).
struct PaperMaterial {
  double stretchStiffness = 5e5, stretchDamping = 4472;
  double bendStiffness = 3e4, bendDamping = 1.74e3;
  double coreStiffness = 1.5e4, coreDamping = 1000;
};

}  // namespace ringlet
