// Implements rest/rest_contacts.h.
#include "ringlet/rest/rest_contacts.h"

#include <algorithm>
#include <utility>

namespace ringlet {

std::vector<std::string> RestContacts::warnings() const {
  std::vector<std::string> all = particles.warnings;
  all.insert(all.end(), graph.warnings.begin(), graph.warnings.end());
  return all;
}

RestContacts buildRestContacts(const RestState& rest, const ContactSettings& settings, unsigned threadCount) {
  ContactParticles particles = chooseContactParticles(rest, settings);
  const bool automatic = settings.mayBeVolume() && settings.method == ContactMethod::automatic;
  const DenseStrands dense =
      automatic || settings.detail < 1 ? findDenseStrands(rest, threadCount) : noDenseStrands(rest);
  VolumeStrands volume = chooseVolumeStrands(rest, particles, dense, settings);
  ContactGraph graph =
      pruneStrandPairs(countOverlaps(rest, particles, settings.enlargement, threadCount), rest, settings);
  RestContacts contacts;
  contacts.kinds = {meetPairByPair(volume, graph), volume.count > 0};
  contacts.overlapsPerParticle =
      static_cast<double>(graph.everyPair ? graph.overlapsUnpruned : graph.overlaps) /
      static_cast<double>(particles.particles.size());
  contacts.particles = std::move(particles);
  contacts.graph = std::move(graph);
  contacts.volume = std::move(volume);
  if (settings.detail < 1) {
    contacts.unthinned = std::move(contacts.particles);
    contacts.particles = thinWhereDense(*contacts.unthinned, rest, dense, settings);
  }
  contacts.particleCount = contacts.particles.particles.size();
  for (const float radius : contacts.particles.radii)
    contacts.largestRadius = std::max(contacts.largestRadius, radius);
  return contacts;
}

}  // namespace ringlet
