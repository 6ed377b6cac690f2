// Implements rest/dense_strands.h.
#include "ringlet/rest/dense_strands.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <span>
#include <utility>

#include "layout/strands.h"
#include "ringlet/rest/cell_map.h"
#include "ringlet/rest/contact_particles.h"
#include "ringlet/rest/density_grid.h"
#include "ringlet/rest/strands_per_part.h"
#include "ringlet/scene/contact_settings.h"

namespace ringlet {
namespace {

// Calls tell(i, mass) for each particle of a strand.
template <class Tell>
void eachParticle(const RestState& rest, const layout::StrandRest& strand, Tell&& tell) {
  for (std::uint32_t i = strand.firstParticle; i < strand.firstParticle + strand.particleCount; ++i)
    tell(i, double(rest.particles[i].mass) * strand.massUnit);
}

// The density of each strand, in multiples of the density of the strand alone. One thread adds masses in
// device order, since the order of a sum changes its bits.
std::vector<double> strandDensities(const RestState& rest, double cell, unsigned threadCount) {
  DensityGrid all(cell);
  for (const layout::StrandRest& strand : rest.strands)
    eachParticle(rest, strand, [&](std::uint32_t i, double mass) { all.add(rest.points[i], mass); });
  std::vector<double> densities(rest.strands.size());
  SharedParts parts(rest.strands.size(), kStrandsPerPart);
  inParallel(threadCount, [&] {
    DensityGrid own(cell);
    parts.take([&](std::size_t begin, std::size_t end) {
      for (std::size_t s = begin; s < end; ++s) {
        const layout::StrandRest& strand = rest.strands[s];
        own.clear();
        eachParticle(rest, strand, [&](std::uint32_t i, double mass) { own.add(rest.points[i], mass); });
        double shares = 0;
        eachParticle(rest, strand, [&](std::uint32_t i, double) {
          shares += own.at(rest.points[i]) / all.at(rest.points[i]);
        });
        densities[s] = strand.particleCount / shares;
      }
    });
  });
  return densities;
}

// The representative of the group of `s` (union-find with path halving).
std::uint32_t firstOf(std::vector<std::uint32_t>& groups, std::uint32_t s) {
  while (groups[s] != s) s = groups[s] = groups[groups[s]];
  return s;
}

// Joins strands in `isIn` that share cells into groups.
std::vector<std::uint32_t> joinedThroughCells(const RestState& rest, const std::vector<bool>& isIn,
                                              double cell) {
  std::vector<std::uint32_t> groups(rest.strands.size());
  std::iota(groups.begin(), groups.end(), 0u);
  CellMap<std::uint32_t> someStrand;  // a strand in each cell
  for (std::uint32_t s = 0; s < rest.strands.size(); ++s) {
    if (!isIn[s]) continue;
    eachParticle(rest, rest.strands[s], [&](std::uint32_t i, double) {
      const std::uint32_t there = someStrand.at(DensityGrid::cellOf(rest.points[i], cell), s);
      const auto [least, most] = std::minmax({firstOf(groups, s), firstOf(groups, there)});
      groups[most] = least;
    });
  }
  for (std::uint32_t s = 0; s < rest.strands.size(); ++s) groups[s] = firstOf(groups, s);
  return groups;
}

// Dissolves groups whose median density is not high enough: each of their strands becomes a group of its own.
void keepDenseGroups(std::span<const double> densities, DenseStrands& dense) {
  std::map<std::uint32_t, std::vector<double>> byGroup;
  for (std::size_t s = 0; s < densities.size(); ++s)
    if (dense.isIn[s]) byGroup[dense.groups[s]].push_back(densities[s]);
  for (auto& [group, all] : byGroup)
    std::ranges::nth_element(all, all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2));
  for (std::uint32_t s = 0; s < densities.size(); ++s) {
    if (!dense.isIn[s]) continue;
    const std::vector<double>& all = byGroup[dense.groups[s]];
    if (all[all.size() / 2] >= kDenseStrands) continue;
    dense.isIn[s] = false;
    dense.groups[s] = s;
  }
}

}  // namespace

double volumeCellFor(const RestState& rest, double radius) {
  double arc = 0, edges = 0;
  for (const layout::StrandRest& strand : rest.strands) {
    for (std::uint32_t i = 0; i + 1 < strand.particleCount; ++i)
      arc += rest.particles[strand.firstParticle + i].edgeLength, ++edges;
  }
  return std::max(kVolumeCellRadii * radius, edges > 0 ? arc / edges / kVolumeSpacing : 0);
}

DenseStrands noDenseStrands(const RestState& rest) {
  DenseStrands none{std::vector<std::uint32_t>(rest.strands.size()), std::vector<bool>(rest.strands.size())};
  std::iota(none.groups.begin(), none.groups.end(), 0u);
  return none;
}

DenseStrands findDenseStrands(const RestState& rest, unsigned threadCount) {
  const double cell = volumeCellFor(rest, radiusOfRoots(rest));
  const std::vector<double> densities = strandDensities(rest, cell, threadCount);
  DenseStrands dense = noDenseStrands(rest);
  for (std::size_t s = 0; s < densities.size(); ++s) dense.isIn[s] = densities[s] >= kDenseStrands / 2;
  dense.groups = joinedThroughCells(rest, dense.isIn, cell);
  keepDenseGroups(densities, dense);
  return dense;
}

}  // namespace ringlet
