// Implements rest/goal_units.h.
#include "ringlet/rest/goal_units.h"

#include <cmath>
#include <span>

namespace ringlet {

std::vector<GoalUnit> goalUnits(std::span<const layout::StrandRest> strands,
                                std::span<const layout::ParticleRest> all, bool shape) {
  const double k = goalStiffness(1);
  std::vector<GoalUnit> units(all.size(), {k, goalDamping(k, 1)});
  if (!shape) return units;
  for (const layout::StrandRest& strand : strands) {
    const auto particles = all.subspan(strand.firstParticle, strand.particleCount);
    double mass = 0, arc = 0;  // [mass unit], [m]
    for (const layout::ParticleRest& particle : particles) mass += static_cast<double>(particle.mass);
    for (const layout::ParticleRest& particle : particles.first(particles.size() - 1))
      arc += static_cast<double>(particle.edgeLength);
    for (std::size_t i = 0; i + 1 < particles.size(); ++i) {
      const double share = mass / (double{particles[i].mass} * double{particles[i].edgeLength});  // [1/m]
      units[strand.firstParticle + i] = {kStandardGravity * share, std::sqrt(kStandardGravity * arc) * share};
    }
  }
  return units;
}

}  // namespace ringlet
