// Implements rest_contacts.h.
#include "reference/rest_contacts.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "ringlet/groom/seeded_random.h"

namespace ringlet::reference {
namespace {

// Radius before strands are looked at one by one [m]: the setting; half the mean distance of a root to its
// nearest other root; half the mean edge, where there is no such distance.
double baseRadius(const std::vector<Field<double>>& strands, const ContactSettings& settings) {
  if (settings.radius) return *settings.radius;
  Field<double> roots;
  double lengthSum = 0, nearestSum = 0;
  std::size_t edgeCount = 0;
  for (const Field<double>& strand : strands) {
    if (!strand.empty()) roots.push_back(strand[0]);
    for (std::size_t i = 0; i + 1 < strand.size(); ++i, ++edgeCount)
      lengthSum += (strand[i + 1] - strand[i]).norm();
  }
  if (roots.size() > 1) {
    for (std::size_t a = 0; a < roots.size(); ++a) {
      double nearest = std::numeric_limits<double>::infinity();
      for (std::size_t b = 0; b < roots.size(); ++b) {
        if (b != a) nearest = std::min(nearest, (roots[a] - roots[b]).norm());
      }
      nearestSum += nearest;
    }
  }
  if (nearestSum > 0) return nearestSum / static_cast<double>(roots.size()) / 2;
  return edgeCount > 0 ? lengthSum / static_cast<double>(edgeCount) / 2 : 0;
}

// Particle pruning: the root; from i the next that is spacing R away, R = 2 radius, but none further than R
// where there is one before it.
std::vector<std::uint32_t> contactParticles(const Field<double>& points, double radius, double spacing) {
  std::vector<std::uint32_t> kept;
  if (points.empty()) return kept;
  kept.push_back(0);
  for (std::uint32_t i = 0, j = 1; j < points.size(); ++j) {
    const double distance = (points[j] - points[i]).norm();
    if (distance < spacing * 2 * radius) continue;
    if (distance > 2 * radius && j > i + 1) --j;
    kept.push_back(j);
    i = j;
  }
  return kept;
}

// With fillGaps, the strand's radius: raised until its spheres leave no gap, where an edge is longer than R.
double closedRadius(const Field<double>& points, double radius, double spacing) {
  for (;;) {
    const std::vector<std::uint32_t> kept = contactParticles(points, radius, spacing);
    double largest = 0;
    for (std::size_t k = 0; k + 1 < kept.size(); ++k) {
      largest = std::max(largest, (points[kept[k + 1]] - points[kept[k]]).norm());
    }
    if (largest <= 2 * radius) return radius;
    radius = largest / 2;
  }
}

}  // namespace

std::vector<std::vector<int>> overlapCounts(const std::vector<Field<double>>& strands,
                                            const RestContacts& rest, double enlargement) {
  const std::size_t strandCount = strands.size();
  std::vector counts(strandCount, std::vector<int>(strandCount, 0));
  for (std::size_t s = 0; s < strandCount; ++s) {
    for (std::size_t t = s + 1; t < strandCount; ++t) {
      for (const std::uint32_t i : rest.particles[s]) {
        for (const std::uint32_t j : rest.particles[t]) {
          if ((strands[s][i] - strands[t][j]).norm() < enlargement * (rest.radii[s] + rest.radii[t])) {
            ++counts[s][t];
          }
        }
      }
      counts[t][s] = counts[s][t];
    }
  }
  return counts;
}

std::vector<std::vector<std::uint32_t>> prunedNeighbours(const std::vector<std::vector<int>>& counts,
                                                         const ContactSettings& settings) {
  const auto strandCount = static_cast<std::uint32_t>(counts.size());
  // What each strand would choose for itself.
  std::vector<std::vector<std::uint32_t>> chosen(strandCount);
  for (std::uint32_t s = 0; s < strandCount; ++s) {
    for (std::uint32_t t = 0; t < strandCount; ++t) {
      if (t != s && counts[s][t] >= settings.minOverlaps) chosen[s].push_back(t);
    }
    if (settings.maxNeighbours > 0 && chosen[s].size() > static_cast<std::size_t>(settings.maxNeighbours)) {
      std::ranges::stable_sort(chosen[s], [&](auto a, auto b) { return counts[s][a] > counts[s][b]; });
      chosen[s].resize(static_cast<std::size_t>(settings.maxNeighbours));
      std::ranges::sort(chosen[s]);
    }
  }
  std::vector<std::vector<std::uint32_t>> neighbours(strandCount);
  for (std::uint32_t s = 0; s < strandCount; ++s) {
    for (const std::uint32_t t : chosen[s]) {
      if (!std::ranges::binary_search(chosen[t], s)) continue;
      const std::uint64_t pair = std::uint64_t{std::min(s, t)} << 32 | std::max(s, t);
      if (SeededRandom(settings.seed, pair).uniform() < settings.dropShare) continue;
      neighbours[s].push_back(t);
    }
  }
  return neighbours;
}

template <class Real>
RestContacts makeRestContacts(const std::vector<RestStrand<Real>>& strands, const ContactSettings& settings) {
  std::vector<Field<double>> points;
  for (const RestStrand<Real>& strand : strands) {
    Field<double>& places = points.emplace_back();
    for (const Vector3<Real>& p : strand.points) places.push_back(p.template cast<double>());
  }
  RestContacts rest;
  const double base = baseRadius(points, settings);
  for (std::size_t s = 0; s < strands.size(); ++s) {
    rest.radii.push_back(settings.fillGaps ? closedRadius(points[s], base, settings.spacing) : base);
    rest.particles.push_back(contactParticles(points[s], rest.radii[s], settings.spacing));
    const double mass = std::accumulate(strands[s].masses.begin(), strands[s].masses.end(), 0.0);
    rest.masses.push_back(mass / static_cast<double>(std::max<std::size_t>(1, rest.particles[s].size())));
  }
  rest.prunesPairs = settings.prunePairs;
  if (rest.prunesPairs) {
    rest.neighbours = prunedNeighbours(overlapCounts(points, rest, settings.enlargement), settings);
  }
  return rest;
}

#define RINGLET_INSTANTIATE(Real)                                                      \
  template RestContacts makeRestContacts(const std::vector<RestStrand<Real>>& strands, \
                                         const ContactSettings& settings)
RINGLET_INSTANTIATE(float);
RINGLET_INSTANTIATE(double);
#undef RINGLET_INSTANTIATE

}  // namespace ringlet::reference
