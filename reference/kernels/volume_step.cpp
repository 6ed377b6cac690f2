// Implements kernels/volume_step.h.
#include "reference/kernels/volume_step.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "reference/equations/volume.h"

namespace ringlet::reference {
namespace {

using Node = std::array<int, 3>;

// tell(node, weight) for the eight nodes about a place.
template <class Tell>
void eachNode(const Vector3<double>& place, double cell, Tell&& tell) {
  const Vector3<double> x = place / cell;
  const Node low{static_cast<int>(std::floor(x[0])), static_cast<int>(std::floor(x[1])),
                 static_cast<int>(std::floor(x[2]))};
  for (int dz = 0; dz < 2; ++dz) {
    for (int dy = 0; dy < 2; ++dy) {
      for (int dx = 0; dx < 2; ++dx) {
        const Node node{low[0] + dx, low[1] + dy, low[2] + dz};
        tell(node, hat(x[0] - node[0]) * hat(x[1] - node[1]) * hat(x[2] - node[2]));
      }
    }
  }
}

// Masses at nodes, of particles `begin` to `end` at their places.
std::map<Node, double> nodeMasses(const Volume& volume, std::size_t begin, std::size_t end) {
  std::map<Node, double> masses;
  for (std::size_t i = begin; i < end; ++i) {
    const VolumeParticle& p = volume.particles[i];
    eachNode(p.place, volume.cell, [&](const Node& node, double weight) { masses[node] += weight * p.mass; });
  }
  return masses;
}

double densityAt(const std::map<Node, double>& masses, const Vector3<double>& place, double cell) {
  double sum = 0;
  eachNode(place, cell, [&](const Node& node, double weight) {
    if (const auto it = masses.find(node); it != masses.end()) sum += weight * it->second;
  });
  return sum / (cell * cell * cell);
}

// One in so many particles of a strand, no further apart along it than kVolumeSpacing cells.
template <class Real>
std::size_t volumeStride(const RestStrand<Real>& strand, double cell) {
  double arc = 0;
  for (const Real length : strand.edgeLengths) arc += static_cast<double>(length);
  const auto count = static_cast<double>(strand.points.size());
  const double edge = arc / std::max(1.0, count - 1);
  return static_cast<std::size_t>(
      std::clamp(std::floor(kVolumeSpacing * cell / edge), 1.0, std::max(1.0, count / 2)));
}

}  // namespace

void Volume::release(std::uint32_t begin, std::uint32_t end) {
  for (VolumeParticle& p : particles)
    if (p.index >= begin && p.index < end) p.mass = 0;
}

void Volume::forget() {
  untilSort = 0;
  for (VolumeParticle& p : particles) {
    p.isKnown = false;
    p.density = p.restDensity;
  }
}

void Volume::archive(Archive& archive) {
  archive.value(untilSort);
  for (VolumeParticle& p : particles) {
    archive.value(p.density);
    archive.value(p.isKnown);
    archive.values(std::span(p.memory.data(), 3));
    archive.values(std::span(p.place.data(), 3));
    archive.values(std::span(p.gridPlace.data(), 3));
    archive.values(std::span(p.given.data(), 3));
  }
}

template <class Real>
Volume makeVolume(const std::vector<RestStrand<Real>>& strands, std::span<const std::uint32_t> firstPoint,
                  const RestContacts& rest) {
  Volume volume;
  volume.cell = rest.volumeCell;
  std::vector<std::size_t> ends;  // of each such strand
  for (std::size_t s = 0; s < strands.size(); ++s) {
    if (!rest.isInVolume(s)) continue;
    const std::size_t stride = volumeStride(strands[s], volume.cell);
    for (std::size_t i = s % stride; i < strands[s].points.size(); i += stride) {
      VolumeParticle p;
      p.index = firstPoint[s] + static_cast<std::uint32_t>(i);
      p.mass = static_cast<double>(stride) * static_cast<double>(strands[s].masses[i]);
      p.place = strands[s].points[i].template cast<double>();
      volume.particles.push_back(p);
    }
    ends.push_back(volume.particles.size());
  }
  const std::map<Node, double> all = nodeMasses(volume, 0, volume.particles.size());
  std::size_t begin = 0;
  for (const std::size_t end : ends) {
    const std::map<Node, double> own = nodeMasses(volume, begin, end);
    for (; begin < end; ++begin) {
      VolumeParticle& p = volume.particles[begin];
      p.restDensity = p.density = densityAt(all, p.place, volume.cell);
      p.ownDensity = densityAt(own, p.place, volume.cell);
    }
  }
  return volume;
}

void beginVolume(const ContactSettings& settings, const VolumeFrame& frame, const Field<double>& positions,
                 const Field<double>& freeVelocities, const Field<double>& changes, Volume& volume) {
  const double kappa = volumeGain(settings, frame.seconds);
  for (VolumeParticle& p : volume.particles) {
    p.guess = freeVelocities[p.index];
    if (p.isKnown && !changes.empty() && p.mass > 0)
      p.guess += guessedChange(kappa, changes[p.index], p.given / p.mass);
    const Vector3<double> place = frame.now.conjugate() * positions[p.index];
    p.memory = p.isKnown ? fadedDisplacement(settings, frame.seconds, p.memory, place - p.place)
                         : Vector3<double>(Vector3<double>::Zero());
    p.place = place;
    if (volume.untilSort == 0) p.gridPlace = place;
    p.share = othersShare(p.ownDensity, p.density);
    p.isKnown = true;
  }
  volume.untilSort = (volume.untilSort > 0 ? volume.untilSort : volumeSortSteps(frame.seconds)) - 1;
}

void endVolume(const Field<double>& velocities, const std::vector<bool>& isPinned, Volume& volume) {
  for (VolumeParticle& p : volume.particles)
    p.given = isPinned[p.index] ? Vector3<double>(Vector3<double>::Zero())
                                : Vector3<double>(p.momentum - p.gain * velocities[p.index]);
}

VolumeSystem volumeMeans(const ContactSettings& settings, const VolumeFrame& frame,
                         const Field<double>& positions, const Field<double>& velocities, Volume& volume) {
  struct Sums {
    Vector3<double> rate{0, 0, 0};  // sum W g a
    double gain = 0, mass = 0;      // sum W g, sum W m
  };
  const double T = frame.seconds, kappa = volumeGain(settings, T);
  const Rotation<double> toHead = frame.now.conjugate();
  std::map<Node, Sums> nodes;
  for (const VolumeParticle& p : volume.particles) {
    const Vector3<double> w = toHead * (velocities[p.index] - frame.carried(positions[p.index]));
    const Vector3<double> a = volumeRate(settings, T, w, p.memory);
    const double g = p.mass * p.share * kappa;
    eachNode(p.gridPlace, volume.cell, [&](const Node& node, double weight) {
      Sums& sums = nodes[node];
      sums.rate += weight * g * a;
      sums.gain += weight * g;
      sums.mass += weight * p.mass;
    });
  }
  VolumeSystem system{Scalars<double>(positions.size(), 0.0),
                      Field<double>(positions.size(), Vector3<double>::Zero())};
  for (VolumeParticle& p : volume.particles) {
    Vector3<double> mean = Vector3<double>::Zero();
    double mass = 0;
    eachNode(p.gridPlace, volume.cell, [&](const Node& node, double weight) {
      const Sums& sums = nodes[node];
      if (sums.gain > 0) mean += weight * sums.rate / sums.gain;
      mass += weight * sums.mass;
    });
    p.density = mass / (volume.cell * volume.cell * volume.cell);
    const double g = p.mass * p.share * kappa;
    const Vector3<double> given = p.mass * p.share * (mean - settings.volumeStiffness * T * p.memory);
    p.gain = system.weights[p.index] = g;
    p.momentum = system.momenta[p.index] = frame.now * given + g * frame.carried(positions[p.index]);
  }
  return system;
}

#define RINGLET_INSTANTIATE(Real)                                                                          \
  template Volume makeVolume(const std::vector<RestStrand<Real>>& strands, std::span<const std::uint32_t>, \
                             const RestContacts& rest)
RINGLET_INSTANTIATE(float);
RINGLET_INSTANTIATE(double);
#undef RINGLET_INSTANTIATE

}  // namespace ringlet::reference
