// Grooms whose strands meet, and what a meeting is judged by: over all pairs, by plain loops.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "reference/step.h"
#include "tests/equations/strand_fixtures.h"

namespace ringlet::reference::test {

/// 0 before t = 0, 1 after 1, smooth between.
inline double ease(double t) {
  const double s = std::clamp(t, 0.0, 1.0);
  return s * s * s * (10 + s * (6 * s - 15));
}

/// Strands at rest apart, that any pair of may touch: contacts on, pairs of strands not pruned.
inline Settings meetingSettings(double radius) {
  Settings settings;
  settings.contacts.on = true;
  settings.contacts.method = ContactMethod::explicitPairs;
  settings.contacts.prunePairs = false;
  settings.contacts.radius = radius;
  return settings;
}

/// Particles of all strands but the roots, moved by up to 4 mm, at up to 0.5 m/s.
inline void disturb(Simulation<double>& simulation, std::span<const std::uint32_t> firstPoint) {
  std::mt19937 random(21);
  Field<double> positions = simulation.positions(), velocities = simulation.velocities();
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const Vector3<double> shift = randomVector(random, 0.004), velocity = randomVector(random, 0.5);
    if (std::ranges::find(firstPoint, i) != firstPoint.end()) continue;
    positions[i] += shift;
    velocities[i] += velocity;
  }
  simulation.setState(positions, velocities);
}

/// Deepest overlap beyond rest of two contact particles of different strands, as a share of R.
template <class Real>
double deepestOverlap(const std::vector<ContactParticle>& particles, const Field<Real>& positions) {
  double deepest = 0;
  for (const ContactParticle& a : particles) {
    for (const ContactParticle& b : particles) {
      if (a.strand >= b.strand || (a.isPinned && b.isPinned)) continue;
      const double R = a.radius + b.radius, rest = std::min(R, (a.restPlace - b.restPlace).norm());
      const double distance = static_cast<double>((positions[a.index] - positions[b.index]).norm());
      deepest = std::max(deepest, (rest - distance) / R);
    }
  }
  return deepest;
}

/// Whether the edges (p0 p1) and (p2 p3) pass through each other while their ends go from `before` to `after`
/// along straight lines. The signed volume of the four ends is a cubic in time; where it is zero they lie in
/// a plane, and the edges either cross there or miss each other.
inline bool passThrough(const std::array<Vector3<double>, 4>& before,
                        const std::array<Vector3<double>, 4>& after) {
  const auto at = [&](double t) {
    std::array<Vector3<double>, 4> p;
    for (std::size_t i = 0; i < 4; ++i) p[i] = before[i] + t * (after[i] - before[i]);
    return p;
  };
  const auto volume = [&](double t) {
    const auto p = at(t);
    return (p[1] - p[0]).cross(p[2] - p[0]).dot(p[3] - p[0]);
  };
  const auto crossAt = [&](double t) {
    const auto p = at(t);
    const Vector3<double> u = p[1] - p[0], w = p[3] - p[2], r = p[2] - p[0];
    const double determinant = u.dot(u) * w.dot(w) - u.dot(w) * u.dot(w);
    const double onFirst = (r.dot(u) * w.dot(w) - r.dot(w) * u.dot(w)) / determinant;
    const double onSecond = (r.dot(u) * u.dot(w) - r.dot(w) * u.dot(u)) / determinant;
    return onFirst >= 0 && onFirst <= 1 && onSecond >= 0 && onSecond <= 1;
  };
  constexpr int kParts = 8;  // of a step: roots of the cubic closer together count as none
  int crossings = 0;
  for (int k = 0; k < kParts; ++k) {
    double low = static_cast<double>(k) / kParts, high = static_cast<double>(k + 1) / kParts;
    const bool isPositive = volume(low) > 0;
    if (isPositive == (volume(high) > 0)) continue;
    for (int halving = 0; halving < 40; ++halving) {
      const double middle = (low + high) / 2;
      ((volume(middle) > 0) == isPositive ? low : high) = middle;
    }
    crossings += crossAt(high);
  }
  return crossings % 2 != 0;
}

/// Edges of different strands that pass through each other between two states of a groom.
inline int crossingCount(std::span<const std::uint32_t> firstPoint, const Field<double>& before,
                         const Field<double>& after) {
  struct MovingEdge {
    std::size_t strand, i;
    Eigen::AlignedBox3d box;
  };
  std::vector<MovingEdge> edges;
  for (std::size_t s = 0; s + 1 < firstPoint.size(); ++s) {
    for (std::size_t i = firstPoint[s]; i + 1 < firstPoint[s + 1]; ++i) {
      edges.push_back({s, i, Eigen::AlignedBox3d(before[i])});
      edges.back().box.extend(before[i + 1]).extend(after[i]).extend(after[i + 1]);
    }
  }
  int count = 0;
  for (const MovingEdge& a : edges) {
    for (const MovingEdge& b : edges) {
      if (a.strand >= b.strand || !a.box.intersects(b.box)) continue;
      count += passThrough({before[a.i], before[a.i + 1], before[b.i], before[b.i + 1]},
                           {after[a.i], after[a.i + 1], after[b.i], after[b.i + 1]});
    }
  }
  return count;
}

}  // namespace ringlet::reference::test
