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

// tell(node, apart) for the eight nodes about a place; apart: of the place from the node [cells].
template <class Tell>
void eachNode(const Vector3<double>& place, double cell, Tell&& tell) {
  const Vector3<double> x = place / cell;
  const Node low{static_cast<int>(std::floor(x[0])), static_cast<int>(std::floor(x[1])),
                 static_cast<int>(std::floor(x[2]))};
  for (int dz = 0; dz < 2; ++dz) {
    for (int dy = 0; dy < 2; ++dy) {
      for (int dx = 0; dx < 2; ++dx) {
        const Node node{low[0] + dx, low[1] + dy, low[2] + dz};
        tell(node, Vector3<double>(x[0] - node[0], x[1] - node[1], x[2] - node[2]));
      }
    }
  }
}

// Masses at nodes, of particles `begin` to `end` at their places.
std::map<Node, double> nodeMasses(const Volume& volume, std::size_t begin, std::size_t end) {
  std::map<Node, double> masses;
  for (std::size_t i = begin; i < end; ++i) {
    const VolumeParticle& p = volume.particles[i];
    eachNode(p.place, volume.cell, [&](const Node& node, const Vector3<double>& apart) {
      masses[node] += nodeWeight(apart) * p.mass;
    });
  }
  return masses;
}

double densityAt(const std::map<Node, double>& masses, const Vector3<double>& place, double cell) {
  double sum = 0;
  eachNode(place, cell, [&](const Node& node, const Vector3<double>& apart) {
    if (const auto it = masses.find(node); it != masses.end()) sum += nodeWeight(apart) * it->second;
  });
  return sum / (cell * cell * cell);
}

// So many particles of a strand are represented by one, no further apart along it than kVolumeSpacing cells.
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

Vector3<double> VolumeParticle::mean(const Field<double>& values) const {
  Vector3<double> sum = Vector3<double>::Zero();
  for (std::uint32_t i = first; i < first + present; ++i) sum += values[i];
  return sum / std::max(1.0, static_cast<double>(present));
}

void Volume::release(std::uint32_t begin, std::uint32_t end) {
  untilSort = 0;
  for (VolumeParticle& p : particles) {
    if (p.first + p.present <= begin || p.first >= end) continue;
    const std::uint32_t left = std::max(begin, p.first) - p.first;
    p.mass *= static_cast<double>(left) / p.present;
    p.present = left;
    p.isKnown = false;  // its mean is elsewhere now
  }
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
    archive.values(std::span(p.gradient.data(), 9));
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
    const std::size_t count = strands[s].points.size();
    for (std::size_t i = 0, end = 0; i < count; i = end) {
      end = std::min(count, i == 0 && s % stride > 0 ? s % stride : i + stride);
      VolumeParticle p;
      p.first = firstPoint[s] + static_cast<std::uint32_t>(i);
      p.count = p.present = static_cast<std::uint32_t>(end - i);
      p.pinned = static_cast<std::uint32_t>(std::clamp(strands[s].pinnedCount(), i, end) - i);
      for (std::size_t k = i; k < end; ++k) {
        p.mass += static_cast<double>(strands[s].masses[k]);
        p.place += strands[s].points[k].template cast<double>() / p.count;
      }
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
  for (VolumeParticle& p : volume.particles) {
    p.velocity = p.mean(freeVelocities);
    if (p.isKnown && !changes.empty() && p.mass > 0)
      p.velocity += guessedChange(settings, frame.seconds, p.mean(changes), p.given / p.mass);
    if (!p.isKnown) p.gradient.setZero();
    const Vector3<double> place = frame.now.conjugate() * p.mean(positions);
    p.memory = p.isKnown ? fadedDisplacement(settings, frame.seconds, p.memory, place - p.place)
                         : Vector3<double>(Vector3<double>::Zero());
    p.place = place;
    if (volume.untilSort == 0) p.gridPlace = place;
    p.share = othersShare(p.ownDensity, p.density);
    p.isKnown = true;
  }
  volume.untilSort = (volume.untilSort > 0 ? volume.untilSort : volumeSortSteps(frame.seconds)) - 1;
}

void bringVolume(const Field<double>& velocities, Volume& volume) {
  for (VolumeParticle& p : volume.particles) p.velocity = p.mean(velocities);
}

namespace {

struct NodeSums {
  Vector3<double> rate{0, 0, 0};  // sum W g (a + C (x_n - x))
  double gain = 0, mass = 0;      // sum W g, sum W m

  Vector3<double> mean() const { return gain > 0 ? rate / gain : Vector3<double>(Vector3<double>::Zero()); }
};

std::map<Node, NodeSums> gatherNodes(const ContactSettings& settings, const VolumeFrame& frame,
                                     const Field<double>& positions, const Volume& volume) {
  const double T = frame.seconds, kappa = settings.volumeGain(T);
  std::map<Node, NodeSums> nodes;
  for (const VolumeParticle& p : volume.particles) {
    const Vector3<double> w = frame.now.conjugate() * (p.velocity - frame.carried(p.mean(positions)));
    const Vector3<double> a = volumeRate(settings, T, w, p.memory);
    const double g = p.mass * p.share * kappa;
    eachNode(p.gridPlace, volume.cell, [&](const Node& node, const Vector3<double>& apart) {
      NodeSums& sums = nodes[node];
      const double weight = nodeWeight(apart);
      sums.rate += weight * g * (a - p.gradient * apart * volume.cell);
      sums.gain += weight * g;
      sums.mass += weight * p.mass;
    });
  }
  return nodes;
}

}  // namespace

VolumeSystem volumeMeans(const ContactSettings& settings, const VolumeFrame& frame,
                         const Field<double>& positions, Volume& volume) {
  const double T = frame.seconds, kappa = settings.volumeGain(T);
  std::map<Node, NodeSums> nodes = gatherNodes(settings, frame, positions, volume);
  VolumeSystem system{Scalars<double>(positions.size(), 0.0),
                      Field<double>(positions.size(), Vector3<double>::Zero())};
  for (VolumeParticle& p : volume.particles) {
    Vector3<double> mean = Vector3<double>::Zero();
    Matrix3<double> gradient = Matrix3<double>::Zero();
    double mass = 0;
    eachNode(p.gridPlace, volume.cell, [&](const Node& node, const Vector3<double>& apart) {
      const NodeSums& sums = nodes[node];
      mean += nodeWeight(apart) * sums.mean();
      gradient += sums.mean() * nodeGradient(apart).transpose() / volume.cell;
      mass += nodeWeight(apart) * sums.mass;
    });
    p.density = mass / (volume.cell * volume.cell * volume.cell);
    const Vector3<double> x = p.gridPlace / volume.cell;
    p.gradient = keptGradient(gradient, x - x.array().floor().matrix());
    const double g = p.mass * p.share * kappa;
    const Vector3<double> given = p.mass * p.share * (mean - settings.volumeStiffness * T * p.memory);
    for (std::uint32_t i = p.first; i < p.first + p.present; ++i) {
      system.weights[i] = g / p.present;
      system.momenta[i] = (frame.now * given + g * frame.carried(positions[i])) / p.present;
    }
  }
  return system;
}

void endVolume(const VolumeSystem& system, const Field<double>& velocities, Volume& volume) {
  for (VolumeParticle& p : volume.particles) {
    p.given.setZero();
    for (std::uint32_t i = p.first + p.pinned; i < p.first + p.present; ++i)
      p.given += system.momenta[i] - system.weights[i] * velocities[i];
  }
}

#define RINGLET_INSTANTIATE(Real)                                                                          \
  template Volume makeVolume(const std::vector<RestStrand<Real>>& strands, std::span<const std::uint32_t>, \
                             const RestContacts& rest)
RINGLET_INSTANTIATE(float);
RINGLET_INSTANTIATE(double);
#undef RINGLET_INSTANTIATE

}  // namespace ringlet::reference
