// Implements rest/rest_volume.h.
#include "ringlet/rest/rest_volume.h"

#include <algorithm>
#include <cmath>

#include "layout/strands.h"
#include "ringlet/base/bounds.h"
#include "ringlet/rest/density_grid.h"
#include "ringlet/rest/strands_per_part.h"

namespace ringlet {
namespace {

double arcLength(const RestState& rest, const layout::StrandRest& strand) {
  double arc = 0;
  for (std::uint32_t i = 0; i + 1 < strand.particleCount; ++i)
    arc += rest.particles[strand.firstParticle + i].edgeLength;
  return arc;
}

// So many particles along a strand are represented by one, so that these are at most kVolumeSpacing cells
// apart.
std::uint32_t volumeStride(const RestState& rest, const layout::StrandRest& strand, double cell) {
  const double edge = arcLength(rest, strand) / std::max(1.0, strand.particleCount - 1.0);
  const double most = std::max(1.0, strand.particleCount / 2.0);
  return static_cast<std::uint32_t>(std::clamp(std::floor(kVolumeSpacing * cell / edge), 1.0, most));
}

// Number of cells in the box that all strands can reach.
std::uint64_t reachableCells(const RestState& rest, const VolumeStrands& volume, double cell) {
  constexpr double kLongest = 1.1;
  Bounds box = Bounds::none();
  for (std::size_t s = 0; s < rest.strands.size(); ++s) {
    if (!volume.isIn[s]) continue;
    const layout::StrandRest& strand = rest.strands[s];
    const double reach = kLongest * arcLength(rest, strand);
    const Vec3d root = static_cast<Vec3d>(rest.points[strand.firstParticle]);
    box.add(root - Vec3d{reach, reach, reach});
    box.add(root + Vec3d{reach, reach, reach});
  }
  const Vec3d size = (box.high - box.low) / cell + Vec3d{3, 3, 3};
  const double cells = size.x * size.y * size.z;
  return cells < 1e18 ? static_cast<std::uint64_t>(cells) : std::uint64_t{1} << 60;
}

Vec3f meanPoint(const RestState& rest, std::uint32_t first, std::uint32_t count) {
  Vec3d sum{};
  for (std::uint32_t i = first; i < first + count; ++i) sum = sum + static_cast<Vec3d>(rest.points[i]);
  return static_cast<Vec3f>(sum / static_cast<double>(count));
}

// Sets the densities, strand by strand. One thread adds masses in device order, since the order of a sum
// changes its bits.
void setDensities(const RestState& rest, RestVolume& volume, unsigned threadCount) {
  const std::size_t count = volume.firsts.size();
  const auto placeOf = [&](std::size_t k) { return meanPoint(rest, volume.firsts[k], volume.counts[k]); };
  DensityGrid all(volume.cell);
  for (std::size_t k = 0; k < count; ++k) all.add(placeOf(k), volume.masses[k]);
  std::vector<std::size_t> firsts;  // index of each strand's first particle, and the end
  for (std::size_t k = 0; k < count; ++k)
    if (k == 0 || volume.strands[k] != volume.strands[k - 1]) firsts.push_back(k);
  firsts.push_back(count);

  volume.densities.resize(count);
  volume.ownDensities.resize(count);
  SharedParts parts(firsts.size() - 1, kStrandsPerPart);
  inParallel(threadCount, [&] {
    DensityGrid own(volume.cell);
    parts.take([&](std::size_t begin, std::size_t end) {
      for (std::size_t s = begin; s < end; ++s) {
        own.clear();
        for (std::size_t k = firsts[s]; k < firsts[s + 1]; ++k) own.add(placeOf(k), volume.masses[k]);
        for (std::size_t k = firsts[s]; k < firsts[s + 1]; ++k) {
          volume.densities[k] = static_cast<float>(all.at(placeOf(k)));
          volume.ownDensities[k] = static_cast<float>(own.at(placeOf(k)));
        }
      }
    });
  });
}

}  // namespace

RestVolume buildRestVolume(const RestState& rest, const RestContacts& contacts, unsigned threadCount) {
  RestVolume volume;
  volume.cell = contacts.volume.cell;
  for (std::uint32_t s = 0; s < rest.strands.size(); ++s) {
    if (!contacts.volume.isIn[s]) continue;
    const layout::StrandRest& strand = rest.strands[s];
    volume.longestStrand = std::max(volume.longestStrand, arcLength(rest, strand));
    const std::uint32_t stride = volumeStride(rest, strand, volume.cell);
    const std::uint32_t phase = rest.strandInGroom[s] % stride;
    for (std::uint32_t begin = 0; begin < strand.particleCount;) {
      const std::uint32_t end =
          std::min(begin == 0 && phase > 0 ? phase : begin + stride, strand.particleCount);
      float mass = 0;
      for (std::uint32_t k = begin; k < end; ++k) mass += rest.particles[strand.firstParticle + k].mass;
      volume.firsts.push_back(strand.firstParticle + begin);
      volume.counts.push_back(end - begin);
      volume.strands.push_back(s);
      volume.masses.push_back(mass * strand.massUnit);
      begin = end;
    }
  }
  setDensities(rest, volume, threadCount);
  for (const float mass : volume.masses) volume.largestMass = std::max(volume.largestMass, mass);
  volume.cells = reachableCells(rest, contacts.volume, volume.cell);
  return volume;
}

}  // namespace ringlet
