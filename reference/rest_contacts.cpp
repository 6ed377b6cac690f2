// Implements rest_contacts.h.
#include "reference/rest_contacts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <utility>

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

namespace {

// One contact particle of a strand in q: larger, and as heavy as the q^2 of before.
void thin(RestContacts& rest, std::size_t s, const ContactSettings& settings) {
  const std::size_t count = rest.particles[s].size();
  const double q =
      std::max(1.0, std::min(std::round(1 / settings.detail), std::floor(static_cast<double>(count) / 2)));
  std::vector<std::uint32_t> kept;
  auto c = static_cast<std::size_t>(q * SeededRandom(settings.seed, s).uniform());
  for (; c < count; c += static_cast<std::size_t>(q)) kept.push_back(rest.particles[s][c]);
  rest.particles[s] = kept;
  rest.radii[s] *= std::pow(q, kThinnedRadiusPower);
  rest.masses[s] *= q * q;
}

using Node = std::array<int, 3>;

// Of a place in cells: the eight nodes about it, with their weights.
std::vector<std::pair<Node, double>> nodesAbout(const Vector3<double>& x) {
  std::vector<std::pair<Node, double>> nodes;
  for (int corner = 0; corner < 8; ++corner) {
    Node node{};
    double weight = 1;
    for (int axis = 0; axis < 3; ++axis) {
      const double low = std::floor(x[axis]);
      const int far = corner >> axis & 1;
      node[static_cast<std::size_t>(axis)] = static_cast<int>(low) + far;
      weight *= far ? x[axis] - low : 1 - (x[axis] - low);
    }
    nodes.emplace_back(node, weight);
  }
  return nodes;
}
void addMass(std::map<Node, double>& masses, const Vector3<double>& x, double mass) {
  for (const auto& [node, weight] : nodesAbout(x)) masses[node] += weight * mass;
}
double massAt(const std::map<Node, double>& masses, const Vector3<double>& x) {
  double sum = 0;
  for (const auto& [node, weight] : nodesAbout(x)) {
    if (const auto it = masses.find(node); it != masses.end()) sum += weight * it->second;
  }
  return sum;
}

template <class Real>
double volumeCell(const std::vector<RestStrand<Real>>& strands, double radius) {
  double arc = 0, edges = 0;
  for (const RestStrand<Real>& strand : strands) {
    if (strand.points.empty()) continue;  // rigid
    for (const Real length : strand.edgeLengths) arc += static_cast<double>(length), ++edges;
  }
  return std::max(kVolumeCellRadii * radius, edges > 0 ? arc / edges / kVolumeSpacing : 0);
}

// Of each strand, by the densities of all strands and of its own. Each takes over the least group it shares a
// cell with until none changes; and groups whose median is dense enough stay.
template <class Real>
std::vector<std::uint32_t> denseGroups(const std::vector<RestStrand<Real>>& strands,
                                       const std::vector<Field<double>>& points, double cell) {
  const std::size_t n = strands.size();
  std::vector<std::uint32_t> groups(n, RestContacts::kNoGroup);
  std::map<Node, double> all;
  const auto mass = [&](std::size_t s, std::size_t i) { return static_cast<double>(strands[s].masses[i]); };
  for (std::size_t s = 0; s < n; ++s) {
    for (std::size_t i = 0; i < points[s].size(); ++i) addMass(all, points[s][i] / cell, mass(s, i));
  }
  std::vector<std::set<Node>> cellsOf(n);
  std::vector<double> densities(n);
  for (std::size_t s = 0; s < n; ++s) {
    std::map<Node, double> own;
    for (std::size_t i = 0; i < points[s].size(); ++i) addMass(own, points[s][i] / cell, mass(s, i));
    double shares = 0;
    for (const Vector3<double>& x : points[s]) shares += massAt(own, x / cell) / massAt(all, x / cell);
    densities[s] = points[s].empty() ? 0 : static_cast<double>(points[s].size()) / shares;
    if (densities[s] < kDenseStrands / 2) continue;
    groups[s] = static_cast<std::uint32_t>(s);
    for (const Vector3<double>& x : points[s]) cellsOf[s].insert(nodesAbout(x / cell).front().first);
  }
  for (bool changes = true; changes;) {
    changes = false;
    std::map<Node, std::uint32_t> least;
    for (std::size_t s = 0; s < n; ++s) {
      for (const Node& node : cellsOf[s]) {
        std::uint32_t& group = least.try_emplace(node, groups[s]).first->second;
        group = std::min(group, groups[s]);
      }
    }
    for (std::size_t s = 0; s < n; ++s) {
      for (const Node& node : cellsOf[s]) {
        changes = changes || least[node] < groups[s];
        groups[s] = std::min(groups[s], least[node]);
      }
    }
  }
  std::vector<std::uint32_t> kept = groups;
  for (std::size_t s = 0; s < n; ++s) {
    if (groups[s] == RestContacts::kNoGroup) continue;
    std::vector<double> ofGroup;
    for (std::size_t t = 0; t < n; ++t)
      if (groups[t] == groups[s]) ofGroup.push_back(densities[t]);
    std::ranges::sort(ofGroup);
    if (ofGroup[ofGroup.size() / 2] < kDenseStrands) kept[s] = RestContacts::kNoGroup;
  }
  return kept;
}

}  // namespace

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
  rest.volumeCell = settings.volumeCell.value_or(volumeCell(strands, base));
  const std::vector<std::uint32_t> dense =
      denseGroups(strands, points, volumeCell(strands, baseRadius(points, {})));
  if (settings.method == ContactMethod::volume)
    rest.volumeGroups.assign(strands.size(), 0);
  else if (settings.mayBeVolume())
    rest.volumeGroups = dense;
  if (settings.bundles) {
    rest.bundles.assign(strands.size(), RestContacts::kNoGroup);
    for (std::size_t b = 0; b < settings.bundles->size(); ++b)
      for (const std::uint32_t s : (*settings.bundles)[b]) {
        rest.bundles[s] = static_cast<std::uint32_t>(b);
        if (!rest.volumeGroups.empty()) rest.volumeGroups[s] = RestContacts::kNoGroup;
      }
  }
  rest.prunesPairs = settings.prunePairs;
  if (rest.prunesPairs) {
    rest.neighbours = prunedNeighbours(overlapCounts(points, rest, settings.enlargement), settings);
  }
  for (std::size_t s = 0; s < strands.size(); ++s)
    if (dense[s] != RestContacts::kNoGroup) thin(rest, s, settings);
  return rest;
}

#define RINGLET_INSTANTIATE(Real)                                                      \
  template RestContacts makeRestContacts(const std::vector<RestStrand<Real>>& strands, \
                                         const ContactSettings& settings)
RINGLET_INSTANTIATE(float);
RINGLET_INSTANTIATE(double);
#undef RINGLET_INSTANTIATE

}  // namespace ringlet::reference
