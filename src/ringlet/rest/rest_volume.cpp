// Implements rest/rest_volume.h.
#include "ringlet/rest/rest_volume.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "layout/strands.h"
#include "ringlet/rest/density_grid.h"

namespace ringlet {
namespace {

double arcLength(const RestState& rest, const layout::StrandRest& strand) {
  double arc = 0;
  for (std::uint32_t i = 0; i + 1 < strand.particleCount; ++i)
    arc += rest.particles[strand.firstParticle + i].edgeLength;
  return arc;
}

// One in so many particles of a strand is enough: they stand no further apart along it than kVolumeSpacing
// cells.
std::uint32_t volumeStride(const RestState& rest, const layout::StrandRest& strand, double cell) {
  const double edge = arcLength(rest, strand) / std::max(1.0, strand.particleCount - 1.0);
  const double most = std::max(1.0, strand.particleCount / 2.0);
  return static_cast<std::uint32_t>(std::clamp(std::floor(kVolumeSpacing * cell / edge), 1.0, most));
}

// Cells of the box that all strands can reach.
std::uint64_t reachableCells(const RestState& rest, const VolumeStrands& volume, double cell) {
  constexpr double kLongest = 1.1;
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Vec3d low{kInfinity, kInfinity, kInfinity}, high = low * -1.0;
  for (std::size_t s = 0; s < rest.strands.size(); ++s) {
    if (!volume.isIn[s]) continue;
    const layout::StrandRest& strand = rest.strands[s];
    const double reach = kLongest * arcLength(rest, strand);
    const Vec3d root = static_cast<Vec3d>(rest.points[strand.firstParticle]);
    low = {std::min(low.x, root.x - reach), std::min(low.y, root.y - reach), std::min(low.z, root.z - reach)};
    high = {std::max(high.x, root.x + reach), std::max(high.y, root.y + reach),
            std::max(high.z, root.z + reach)};
  }
  const Vec3d size = (high - low) / cell + Vec3d{3, 3, 3};
  const double cells = size.x * size.y * size.z;
  return cells < 1e18 ? static_cast<std::uint64_t>(cells) : std::uint64_t{1} << 60;
}

}  // namespace

RestVolume buildRestVolume(const RestState& rest, const RestContacts& contacts) {
  RestVolume volume;
  volume.cell = contacts.volume.cell;
  DensityGrid all(volume.cell);
  for (std::uint32_t s = 0; s < rest.strands.size(); ++s) {
    if (!contacts.volume.isIn[s]) continue;
    const layout::StrandRest& strand = rest.strands[s];
    volume.longestStrand = std::max(volume.longestStrand, arcLength(rest, strand));
    DensityGrid own(volume.cell);
    const std::size_t first = volume.particles.size();
    const std::uint32_t stride = volumeStride(rest, strand, volume.cell);
    for (std::uint32_t k = rest.strandInGroom[s] % stride; k < strand.particleCount; k += stride) {
      const std::uint32_t i = strand.firstParticle + k;
      const float mass = static_cast<float>(stride) * rest.particles[i].mass * strand.massUnit;
      volume.particles.push_back(i);
      volume.strands.push_back(s);
      volume.masses.push_back(mass);
      all.add(rest.points[i], mass);
      own.add(rest.points[i], mass);
    }
    for (std::size_t k = first; k < volume.particles.size(); ++k)
      volume.ownDensities.push_back(static_cast<float>(own.at(rest.points[volume.particles[k]])));
  }
  for (const std::uint32_t i : volume.particles)
    volume.densities.push_back(static_cast<float>(all.at(rest.points[i])));
  for (const float mass : volume.masses) volume.largestMass = std::max(volume.largestMass, mass);
  volume.cells = reachableCells(rest, contacts.volume, volume.cell);
  return volume;
}

}  // namespace ringlet
