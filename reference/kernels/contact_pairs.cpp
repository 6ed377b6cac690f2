// Implements kernels/contact_pairs.h.
#include "reference/kernels/contact_pairs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace ringlet::reference {

bool mayTouch(const RestContacts& rest, const ContactParticle& a, const ContactParticle& b) {
  return a.strand != b.strand && !(a.isPinned && b.isPinned) && rest.mayTouch(a.strand, b.strand);
}

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

NearPairs nearPairs(const RestContacts& rest, const std::vector<ContactParticle>& particles,
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
      const int layer = neighbour / 9;
      const auto found = grid.find(
          {centre[0] + neighbour % 3 - 1, centre[1] + neighbour / 3 % 3 - 1, centre[2] + layer - 1});
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

#define RINGLET_INSTANTIATE(Real)                                                                          \
  template std::vector<ContactParticle> listContactParticles(const RestContacts& rest,                     \
                                                             const std::vector<RestStrand<Real>>& strands, \
                                                             std::span<const std::uint32_t> firstPoint)
RINGLET_INSTANTIATE(float);
RINGLET_INSTANTIATE(double);
#undef RINGLET_INSTANTIATE

}  // namespace ringlet::reference
