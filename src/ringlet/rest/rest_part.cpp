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

void keepStrands(RestState& state, std::span<const std::uint32_t> here,
                 std::span<const std::uint32_t> around) {
  RestState whole = std::exchange(state, {});
  std::swap(state.rigid, whole.rigid);
  std::swap(state.warnings, whole.warnings);
  state.materialWarningCount = whole.materialWarningCount;
  state.groomStrandCount = whole.groomStrandCount, state.groomParticleCount = whole.groomParticleCount;
  state.longestCalmStep = whole.longestCalmStep;
  state.oneSmoothing = whole.oneSmoothing;
  std::swap(state.wholeCounts, whole.wholeCounts);
  std::vector<bool> isKept(whole.strands.size());
  const auto keep = [&](std::size_t s) {
    isKept[s] = true;
    layout::StrandRest strand = whole.strands[s];
    const auto points = whole.points.begin() + strand.firstParticle;
    const auto particles = whole.particles.begin() + strand.firstParticle;
    strand.firstParticle = static_cast<std::uint32_t>(state.points.size());
    state.strands.push_back(strand);
    state.strandInGroom.push_back(whole.strandInGroom[s]);
    state.firstInGroom.push_back(whole.firstInGroom[s]);
    state.points.insert(state.points.end(), points, points + strand.particleCount);
    state.particles.insert(state.particles.end(), particles, particles + strand.particleCount);
    if (whole.edgeFactors.empty()) return;
    const auto factors = whole.edgeFactors.begin() + whole.strands[s].firstParticle;
    state.edgeFactors.insert(state.edgeFactors.end(), factors, factors + strand.particleCount);
  };
  for (const std::uint32_t s : here) keep(s);
  for (const std::uint32_t s : around) keep(s);
  state.haloCount = around.size();
  for (std::size_t s = 0; s < whole.strands.size(); ++s) {
    if (isKept[s]) continue;
    const auto first = whole.points.begin() + whole.strands[s].firstParticle;
    state.elsewhere.push_back(
        {whole.strandInGroom[s], whole.firstInGroom[s], {first, first + whole.strands[s].particleCount}});
  }
  std::ranges::sort(state.elsewhere, {}, &RigidStrand::strandInGroom);
}

Status restrictTo(RestState& state, std::span<const std::uint32_t> part) {
  const auto isIn = membersOf(part, state.groomStrandCount);
  if (!isIn) return isIn.error();
  std::vector<std::uint32_t> here;
  for (std::uint32_t s = 0; s < state.strands.size(); ++s)
    if ((*isIn)[state.strandInGroom[s]]) here.push_back(s);
  keepStrands(state, here);
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

constexpr std::uint32_t kGone = 0xffffffff;

// The places of strands and particles of a whole groom in what is kept of it; device order.
class Places {
 public:
  Places(const std::vector<layout::StrandRest>& whole, const RestHalo& halo) : places_(whole.size()) {
    std::uint32_t strands = 0, particles = 0;
    for (const auto* some : {&halo.here, &halo.around}) {
      for (const std::uint32_t s : *some) {
        places_[s] = {strands++, whole[s].firstParticle, particles};
        particles += whole[s].particleCount;
      }
    }
    count_ = strands;
  }
  std::uint32_t strand(std::uint32_t s) const { return places_[s].strand; }
  std::uint32_t particle(std::uint32_t s, std::uint32_t i) const {
    return i - places_[s].before + places_[s].first;
  }
  // The entries of kept strands from a list over all strands, in their new order.
  template <class T>
  std::vector<T> kept(const std::vector<T>& all) const {
    std::vector<T> kept(count_);
    for (std::size_t s = 0; s < all.size(); ++s)
      if (places_[s].strand != kGone) kept[places_[s].strand] = all[s];
    return kept;
  }

 private:
  struct Place {
    std::uint32_t strand = kGone, before = 0, first = 0;  // its first particle, old and new
  };
  std::vector<Place> places_;
  std::uint32_t count_ = 0;
};

void restrictTo(ContactGraph& graph, const RestHalo& halo, const Places& places) {
  if (graph.everyPair) return;
  const std::vector<std::uint32_t> first = std::exchange(graph.firstNeighbour, {0});
  const std::vector<std::uint32_t> neighbours = std::exchange(graph.neighbours, {});
  graph.counts.clear();
  for (const std::uint32_t s : halo.here) {
    for (std::uint32_t k = first[s]; k < first[s + 1]; ++k)
      if (places.strand(neighbours[k]) != kGone) graph.neighbours.push_back(places.strand(neighbours[k]));
    std::sort(graph.neighbours.begin() + graph.firstNeighbour.back(), graph.neighbours.end());
    graph.firstNeighbour.push_back(static_cast<std::uint32_t>(graph.neighbours.size()));
  }
  graph.firstNeighbour.resize(halo.here.size() + halo.around.size() + 1, graph.firstNeighbour.back());
}

void restrictTo(RestContacts& contacts, const RestHalo& halo, const Places& places) {
  const ContactParticles whole = std::exchange(contacts.particles, {});
  ContactParticles& own = contacts.particles;
  own.baseRadius = whole.baseRadius;
  own.radii = places.kept(whole.radii);
  own.masses = places.kept(whole.masses);
  for (std::uint32_t c = 0; c < whole.particles.size(); ++c) {
    const std::uint32_t s = whole.strands[c];
    if (places.strand(s) == kGone) continue;
    own.particles.push_back(places.particle(s, whole.particles[c]));
    own.strands.push_back(places.strand(s));
    contacts.inWhole.push_back(c);
  }
  restrictTo(contacts.graph, halo, places);
  contacts.unthinned.reset();
  contacts.volume.groups = places.kept(contacts.volume.groups);
  contacts.volume.isIn = places.kept(contacts.volume.isIn);
}

void restrictTo(RestVolume& volume, const RestHalo& halo, const Places& places) {
  const auto end = static_cast<std::uint32_t>(halo.here.size());
  const RestVolume whole = std::exchange(volume, {});
  volume.cell = whole.cell, volume.largestMass = whole.largestMass, volume.cells = whole.cells;
  volume.longestStrand = whole.longestStrand;
  for (std::size_t i = 0; i < whole.firsts.size(); ++i) {
    const std::uint32_t s = whole.strands[i];
    if (places.strand(s) >= end) continue;
    volume.firsts.push_back(places.particle(s, whole.firsts[i]));
    volume.counts.push_back(whole.counts[i]);
    volume.strands.push_back(places.strand(s));
    volume.masses.push_back(whole.masses[i]);
    volume.densities.push_back(whole.densities[i]);
    volume.ownDensities.push_back(whole.ownDensities[i]);
  }
}

}  // namespace

void restrictTo(const RestHair& hair, RestHalo& halo) {
  const Places places(hair.state.strands, halo);
  restrictTo(hair.contacts, halo, places);
  if (hair.volume) restrictTo(*hair.volume, halo, places);
  keepStrands(hair.state, halo.here, halo.around);
  const auto renumber = [&](std::vector<std::uint32_t>& strands) {
    for (std::uint32_t& s : strands) s = places.strand(s);
  };
  for (RestHalo::Peer& peer : halo.peers) renumber(peer.out), renumber(peer.in);
  renumber(halo.here), renumber(halo.around);
}

}  // namespace ringlet
