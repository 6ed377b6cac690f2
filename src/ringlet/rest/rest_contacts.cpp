// Implements rest/rest_contacts.h.
#include "ringlet/rest/rest_contacts.h"

#include <utility>

namespace ringlet {

std::vector<std::string> RestContacts::warnings() const {
  std::vector<std::string> all = particles.warnings;
  all.insert(all.end(), graph.warnings.begin(), graph.warnings.end());
  return all;
}

RestContacts buildRestContacts(const RestState& rest, const ContactSettings& settings) {
  ContactParticles particles = chooseContactParticles(rest, settings);
  const bool automatic = settings.mayBeVolume() && settings.method == ContactMethod::automatic;
  const DenseStrands dense = automatic || settings.detail < 1 ? findDenseStrands(rest) : noDenseStrands(rest);
  VolumeStrands volume = chooseVolumeStrands(rest, particles, dense, settings);
  ContactGraph graph = pruneStrandPairs(countOverlaps(rest, particles, settings.enlargement), rest, settings);
  RestContacts contacts{std::move(particles), std::move(graph), std::move(volume), {}};
  if (settings.detail < 1) {
    contacts.unthinned = std::move(contacts.particles);
    contacts.particles = thinWhereDense(*contacts.unthinned, rest, dense, settings);
  }
  return contacts;
}

}  // namespace ringlet
