// Implements rest/rest_part.h.
#include "ringlet/rest/rest_part.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace ringlet {
Result<std::vector<bool>> membersOf(std::span<const std::uint32_t> part, std::size_t strandCount) {
  std::vector<bool> isIn(strandCount);
  for (const std::uint32_t strand : part) {
    if (strand >= strandCount)
      return Error{
          fmt::format("a part names strand {}; the groom has {}, numbered from 0", strand, strandCount)};
    if (isIn[strand]) return Error{fmt::format("strand {} is in a part twice", strand)};
    isIn[strand] = true;
  }
  return isIn;
}

Status restrictTo(RestState& state, std::span<const std::uint32_t> part) {
  const auto isIn = membersOf(part, state.groomStrandCount);
  if (!isIn) return isIn.error();
  RestState whole = std::exchange(state, {});
  std::swap(state.rigid, whole.rigid);
  std::swap(state.warnings, whole.warnings);
  state.materialWarningCount = whole.materialWarningCount;
  state.groomStrandCount = whole.groomStrandCount, state.groomParticleCount = whole.groomParticleCount;
  state.longestCalmStep = whole.longestCalmStep;
  state.oneSmoothing = whole.oneSmoothing;
  std::swap(state.wholeCounts, whole.wholeCounts);
  for (std::size_t s = 0; s < whole.strands.size(); ++s) {
    layout::StrandRest strand = whole.strands[s];
    const auto first = whole.points.begin() + strand.firstParticle;
    if (!(*isIn)[whole.strandInGroom[s]]) {
      state.elsewhere.push_back(
          {whole.strandInGroom[s], whole.firstInGroom[s], {first, first + strand.particleCount}});
      continue;
    }
    const auto particles = whole.particles.begin() + strand.firstParticle;
    strand.firstParticle = static_cast<std::uint32_t>(state.points.size());
    state.strands.push_back(strand);
    state.strandInGroom.push_back(whole.strandInGroom[s]);
    state.firstInGroom.push_back(whole.firstInGroom[s]);
    state.points.insert(state.points.end(), first, first + strand.particleCount);
    state.particles.insert(state.particles.end(), particles, particles + strand.particleCount);
    if (whole.edgeFactors.empty()) continue;
    const auto factors = whole.edgeFactors.begin() + whole.strands[s].firstParticle;
    state.edgeFactors.insert(state.edgeFactors.end(), factors, factors + strand.particleCount);
  }
  std::ranges::sort(state.elsewhere, {}, &RigidStrand::strandInGroom);
  return {};
}

Result<std::vector<std::size_t>> partOfEach(const std::vector<std::vector<std::uint32_t>>& parts,
                                            const RestState& rest) {
  std::vector<std::size_t> partOf(rest.strands.size());
  std::vector<int> counts(rest.strands.size());
  for (std::size_t part = 0; part < parts.size(); ++part) {
    const auto isIn = membersOf(parts[part], rest.groomStrandCount);
    if (!isIn) return isIn.error();
    for (std::size_t s = 0; s < partOf.size(); ++s) {
      if ((*isIn)[rest.strandInGroom[s]]) partOf[s] = part, ++counts[s];
    }
  }
  for (std::size_t s = 0; s < counts.size(); ++s) {
    if (counts[s] != 1)
      return Error{fmt::format("strand {} is in {} parts of the hair; every strand is in one",
                               rest.strandInGroom[s], counts[s])};
  }
  return partOf;
}

namespace {

// Where the strands and particles of a whole groom are in what is kept of it; device order.
class Places {
 public:
  Places(const std::vector<layout::StrandRest>& whole, const std::vector<bool>& isKept) {
    std::uint32_t strands = 0, particles = 0;
    for (std::size_t s = 0; s < whole.size(); ++s) {
      strand_.push_back(strands);
      back_.push_back(whole[s].firstParticle - particles);
      if (!isKept[s]) continue;
      ++strands, particles += whole[s].particleCount;
    }
  }
  std::uint32_t strand(std::uint32_t s) const { return strand_[s]; }
  std::uint32_t particle(std::uint32_t strand, std::uint32_t i) const { return i - back_[strand]; }

 private:
  std::vector<std::uint32_t> strand_, back_;  // of each strand: its new place, and by how much particles move
};

template <class T>
std::vector<T> keep(const std::vector<T>& all, const std::vector<bool>& isKept) {
  std::vector<T> kept;
  for (std::size_t k = 0; k < all.size(); ++k)
    if (isKept[k]) kept.push_back(all[k]);
  return kept;
}

void restrictTo(RestContacts& contacts, const RestHalo& halo, const Places& places) {
  const ContactParticles whole = std::exchange(contacts.particles, {});
  ContactParticles& own = contacts.particles;
  own.baseRadius = whole.baseRadius;
  own.radii = keep(whole.radii, halo.isKnown);
  own.masses = keep(whole.masses, halo.isKnown);
  own.firstOfStrand.push_back(0);
  ContactGraph& graph = contacts.graph;
  const std::vector<std::uint32_t> first = std::exchange(graph.firstNeighbour, {0});
  const std::vector<std::uint32_t> neighbours = std::exchange(graph.neighbours, {});
  graph.counts.clear();
  for (std::uint32_t s = 0; s < halo.isKnown.size(); ++s) {
    if (!halo.isKnown[s]) continue;
    for (std::uint32_t c = whole.firstOfStrand[s]; c < whole.firstOfStrand[s + 1]; ++c) {
      own.particles.push_back(places.particle(s, whole.particles[c]));
      own.strands.push_back(places.strand(s));
      contacts.inWhole.push_back(c);
    }
    own.firstOfStrand.push_back(static_cast<std::uint32_t>(own.particles.size()));
    if (halo.isHere[s] && !graph.everyPair) {
      for (std::uint32_t k = first[s]; k < first[s + 1]; ++k)
        if (halo.isKnown[neighbours[k]]) graph.neighbours.push_back(places.strand(neighbours[k]));
    }
    graph.firstNeighbour.push_back(static_cast<std::uint32_t>(graph.neighbours.size()));
  }
  contacts.unthinned.reset();
  contacts.volume.groups = keep(contacts.volume.groups, halo.isKnown);
  contacts.volume.isIn = keep(contacts.volume.isIn, halo.isKnown);
}

void restrictTo(RestVolume& volume, const RestHalo& halo, const Places& places) {
  std::vector<bool> isHere;
  for (const std::uint32_t s : volume.strands) isHere.push_back(halo.isHere[s]);
  volume.particles = keep(volume.particles, isHere);
  volume.strands = keep(volume.strands, isHere);
  volume.masses = keep(volume.masses, isHere);
  volume.densities = keep(volume.densities, isHere);
  volume.ownDensities = keep(volume.ownDensities, isHere);
  for (std::size_t i = 0; i < volume.strands.size(); ++i) {
    std::uint32_t& s = volume.strands[i];
    volume.particles[i] = places.particle(s, volume.particles[i]);
    s = places.strand(s);
  }
}

}  // namespace

Status restrictTo(const RestHair& hair, RestHalo& halo) {
  const Places places(hair.state.strands, halo.isKnown);
  restrictTo(hair.contacts, halo, places);
  if (hair.volume) restrictTo(*hair.volume, halo, places);
  if (Status done = restrictTo(hair.state, keep(hair.state.strandInGroom, halo.isKnown)); !done) return done;
  halo.isHere = keep(halo.isHere, halo.isKnown);
  for (RestHalo::Peer& peer : halo.peers) {
    for (std::uint32_t& s : peer.out) s = places.strand(s);
    for (std::uint32_t& s : peer.in) s = places.strand(s);
  }
  halo.isKnown.assign(halo.isHere.size(), true);
  return {};
}

}  // namespace ringlet
