// Implements rest/goal.h.
#include "ringlet/rest/goal.h"

namespace ringlet {

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
