// LiveMaterial: a material that changes while hair moves. Springs' constants follow from the material; rest
// targets contain gravity's load divided by the stiffness, so they follow by the ratio of stiffnesses.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "layout/strands.h"
#include "ringlet/base/result.h"
#include "ringlet/base/vec3.h"
#include "ringlet/rest/material.h"
#include "ringlet/rest/rest_state.h"
#include "ringlet/rest/strand_constants.h"
#include "ringlet/scene/settings.h"

namespace ringlet {

/// The first number that differs and must not change while hair moves, by its name in a material file; "" for
/// none. Stiffnesses, dampings, the blend of the core and the variation may change.
std::string fixedDifference(const Material& a, const Material& b);

class LiveMaterial {
 public:
  /// `rest`: as it was built with this material and these settings; needs `jacobi`. Cost: that of two more
  /// rest states.
  static Result<LiveMaterial> create(const RestState& rest, const Material& material,
                                     const Settings& settings);

  /// The same rest state with another material without a fixedDifference: sets the springs of `strands` and
  /// returns all particles, both in device order. `warnings`: sentences for the user. Cost: a pass over
  /// particles in float, and a few numbers a strand.
  std::vector<layout::ParticleRest> with(const Material& material, std::span<layout::StrandRest> strands,
                                         std::vector<std::string>& warnings) const;

 private:
  struct Strand {
    StrandGeometry geometry;
    StrandConstants built{};
    double load = 0, stiffest = 1;  // of the preload; largest factor of the bend stiffness profile
    std::uint32_t strandInGroom = 0, firstParticle = 0, particleCount = 0;
  };

  // What gravity's load subtracts from a particle's target and its edge's rest length.
  struct Load {
    layout::vec3 bend;
    float stretch = 0;
  };

  Settings settings_;
  double lineDensity_ = 0;
  std::vector<Strand> strands_;                  // device order
  std::vector<layout::ParticleRest> particles_;  // without the load
  std::vector<Load> loads_;
};

}  // namespace ringlet
