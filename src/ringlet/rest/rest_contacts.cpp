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
  VolumeStrands volume = chooseVolumeStrands(rest, particles, settings);
  ContactGraph graph = pruneStrandPairs(countOverlaps(rest, particles, settings.enlargement), rest, settings);
  return {std::move(particles), std::move(graph), std::move(volume)};
}

}  // namespace ringlet
