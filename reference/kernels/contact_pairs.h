// Which contact particles are near enough to touch within a step, or to have touched: a superset of all
// contacts, found by a grid. Mirrors the contact kernels' grid and pair list; nothing but time depends on
// how. Iben et al. 2012, section 4; seeing ahead is ours.
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <map>

#include "reference/fields.h"
#include "reference/rest_contacts.h"

namespace ringlet::reference {

/// A particle that takes part in contacts.
struct ContactParticle {
  std::uint32_t index = 0;   // in the groom
  std::uint32_t strand = 0;  // in the groom
  bool isPinned = false;
  double radius = 0;                                    // [m]
  double mass = 0;                                      // m_c [kg]
  Vector3<double> restPlace = Vector3<double>::Zero();  // [m]
};

/// Two particles, by their places in a list of ContactParticle; a before b.
struct ContactPair {
  std::uint32_t a = 0, b = 0;
  auto operator<=>(const ContactPair&) const = default;
};

/// Groom order. `firstPoint` as in Groom.
template <class Real>
std::vector<ContactParticle> listContactParticles(const RestContacts& rest,
                                                  const std::vector<RestStrand<Real>>& strands,
                                                  std::span<const std::uint32_t> firstPoint) {
  std::vector<ContactParticle> list;
  for (std::uint32_t s = 0; s < strands.size(); ++s) {
    for (const std::uint32_t i : rest.particles[s]) {
      list.push_back({.index = firstPoint[s] + i,
                      .strand = s,
                      .isPinned = i < strands[s].rootCount,
                      .radius = rest.radii[s],
                      .mass = rest.masses[s],
                      .restPlace = strands[s].points[i].template cast<double>()});
    }
  }
  return list;
}

inline bool mayTouch(const RestContacts& rest, const ContactParticle& a, const ContactParticle& b) {
  return a.strand != b.strand && !(a.isPinned && b.isPinned) && rest.mayTouch(a.strand, b.strand);
}

/// What the grid found, and how often it looked: from both sides of a pair.
struct NearPairs {
  std::vector<ContactPair> pairs;
  std::uint64_t tests = 0;
};

/// All pairs that may touch and are no further apart than the sum of their `reaches` [m], ascending. Entries
/// of places [m] and reaches follow `particles`. A particle without a reach, or whose place or reach is not
/// finite, has no pairs.
inline NearPairs nearPairs(const RestContacts& rest, const std::vector<ContactParticle>& particles,
                           const Field<double>& places, const Scalars<double>& reaches) {
  double cellSize = 0;  // whoever is near is in a neighbouring cell
  for (const double reach : reaches) {
    if (std::isfinite(reach)) cellSize = std::max(cellSize, 2 * reach);
  }
  using Cell = std::array<double, 3>;  // whole numbers
  const auto cellOf = [&](std::size_t k) {
    return Cell{std::floor(places[k].x() / cellSize), std::floor(places[k].y() / cellSize),
                std::floor(places[k].z() / cellSize)};
  };
  const auto isUsable = [&](std::size_t k) {
    return places[k].allFinite() && std::isfinite(reaches[k]) && reaches[k] > 0;
  };
  std::map<Cell, std::vector<std::uint32_t>> grid;
  for (std::uint32_t k = 0; k < particles.size(); ++k) {
    if (isUsable(k)) grid[cellOf(k)].push_back(k);
  }

  NearPairs near;
  std::vector<ContactPair>& pairs = near.pairs;
  for (std::uint32_t a = 0; a < particles.size(); ++a) {
    if (!isUsable(a)) continue;
    const std::size_t firstOfA = pairs.size();
    const Cell centre = cellOf(a);
    for (int neighbour = 0; neighbour < 27; ++neighbour) {
      const auto found = grid.find(
          {centre[0] + neighbour % 3 - 1, centre[1] + neighbour / 3 % 3 - 1, centre[2] + neighbour / 9 - 1});
      if (found == grid.end()) continue;
      near.tests += found->second.size();
      for (const std::uint32_t b : found->second) {
        if (b <= a || (places[a] - places[b]).norm() > reaches[a] + reaches[b]) continue;
        if (mayTouch(rest, particles[a], particles[b])) pairs.push_back({a, b});
      }
    }
    std::sort(pairs.begin() + static_cast<std::ptrdiff_t>(firstOfA), pairs.end());
  }
  return near;
}

}  // namespace ringlet::reference
