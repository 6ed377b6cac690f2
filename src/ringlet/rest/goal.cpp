// Implements rest/goal.h.
#include "ringlet/rest/goal.h"

#include <span>

namespace ringlet {

std::vector<GoalUnit> goalUnits(const RestState& rest, bool shape) {
  const double k = goalStiffness(1);
  std::vector<GoalUnit> units(rest.particles.size(), {k, goalDamping(k, 1)});
  if (!shape) return units;
  for (const layout::StrandRest& strand : rest.strands) {
    const std::span particles(rest.particles.begin() + strand.firstParticle, strand.particleCount);
    double mass = 0, arc = 0;  // [mass unit], [m]
    for (const layout::ParticleRest& particle : particles) mass += static_cast<double>(particle.mass);
    for (const layout::ParticleRest& particle : particles.first(particles.size() - 1))
      arc += static_cast<double>(particle.edgeLength);
    for (std::size_t i = 0; i + 1 < particles.size(); ++i) {
      const double l = particles[i].edgeLength, m = particles[i].mass;
      units[strand.firstParticle + i] = {shapeStiffness(1, mass, l, m), shapeDamping(1, 1, mass, arc, l, m)};
    }
  }
  return units;
}

GroomGoal goalOf(const Groom& groom) {
  GroomGoal goal;
  goal.shares.assign(groom.points.size(), 0);
  for (const Vec3f& p : groom.points)
    goal.places.push_back(static_cast<Vec3f>(Vec3d(p) * groom.metresPerUnit));
  for (std::size_t s = 0; s < groom.strandCount(); ++s) {
    const std::uint32_t first = groom.firstPoint[s], end = groom.firstPoint[s + 1];
    std::vector<double> arcs{0};
    for (std::uint32_t i = first + 1; i < end; ++i)
      arcs.push_back(arcs.back() + length(Vec3d(groom.points[i]) - Vec3d(groom.points[i - 1])));
    for (std::uint32_t i = first; i < end && arcs.back() > 0; ++i)
      goal.shares[i] = static_cast<float>(arcs[i - first] / arcs.back());
  }
  return goal;
}

std::vector<float> strengthsOf(const GroomGoal& goal, const GoalSettings& settings) {
  std::vector<float> strengths;
  for (const float share : goal.shares) {
    const double profile = 1 + (settings.tipShare - 1) * static_cast<double>(share);
    strengths.push_back(static_cast<float>(settings.strength * profile));
  }
  return strengths;
}

}  // namespace ringlet
