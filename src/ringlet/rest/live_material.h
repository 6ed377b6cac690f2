// LiveMaterial: a material that changes while hair moves. Springs' constants are a law of the material; rest
// targets hold gravity's load over the stiffness, so they follow by the ratio of stiffnesses.
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

/// The first number that differs and may not change while hair moves, as a material file names it; "" for
/// none. What may: the stiffnesses, dampings, the core's blend, the variation.
std::string fixedDifference(const Material& a, const Material& b);

class LiveMaterial {
 public:
  /// `rest`: as it was built with this material and these settings; `jacobi` only. Cost: two rest states
  /// more.
  static Result<LiveMaterial> create(const RestState& rest, const Material& material,
                                     const Settings& settings);

  /// The same rest state with another material that differs in nothing fixed: sets the springs of `strands`,
  /// all in device order, and gives all particles. What is printed of it for the user: `warnings`. Cost: a
  /// pass over particles in float, and a few numbers a strand.
  std::vector<layout::ParticleRest> with(const Material& material, std::span<layout::StrandRest> strands,
                                         std::vector<std::string>& warnings) const;

 private:
  struct Strand {
    StrandGeometry geometry;
    StrandConstants built{};
    double load = 0, stiffest = 1;  // of the preload, and of the bend stiffness profile
    std::uint32_t strandInGroom = 0, firstParticle = 0, particleCount = 0;
  };

  // What it takes from a particle's target and its edge's rest length.
  struct Load {
    layout::vec3 bend;
    float stretch = 0;
  };

  Settings settings_;
  double lineDensity_ = 0;
  std::vector<Strand> strands_;                  // device order
  std::vector<layout::ParticleRest> particles_;  // without load
  std::vector<Load> loads_;
};

}  // namespace ringlet
