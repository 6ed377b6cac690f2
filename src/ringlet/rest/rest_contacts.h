// RestContacts: who may touch whom, decided once in the rest pose; what the solver, the measures and the
// reports of contacts all start from. Iben et al. 2012, section 4. Mirrored by reference/rest_contacts.h.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ringlet/rest/contact_graph.h"
#include "ringlet/rest/contact_particles.h"
#include "ringlet/rest/rest_state.h"
#include "ringlet/rest/volume_strands.h"
#include "ringlet/scene/contact_settings.h"

namespace ringlet {

/// Which ways of contact a run has.
struct ContactKinds {
  bool pairs = false;   // strands meet pair by pair
  bool volume = false;  // some hair meets as a volume

  bool any() const { return pairs || volume; }
};

/// Device order, as RestState.
struct RestContacts {
  ContactParticles particles;  // by which the solver lets strands meet
  ContactGraph graph;
  VolumeStrands volume;
  std::optional<ContactParticles> unthinned;  // where dense strands are thinned: what there was before

  /// By which what strands do is measured.
  const ContactParticles& allParticles() const { return unthinned ? *unthinned : particles; }

  ContactKinds kinds() const { return {meetPairByPair(volume, graph), volume.count > 0}; }
  /// For the user, a sentence each: of gaps or raised radii, and of pruning that leaves nothing.
  std::vector<std::string> warnings() const;
};

/// Cost: of countOverlaps, which is nearly all of it.
RestContacts buildRestContacts(const RestState& rest, const ContactSettings& settings);

}  // namespace ringlet
