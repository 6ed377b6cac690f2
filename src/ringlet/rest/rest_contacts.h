// RestContacts: contact particles and the pairs of strands that may touch, found once in the rest pose. The
// solver, the measures and the reports of contacts use it. Iben et al. 2012, section 4. Mirrored by
// reference/rest_contacts.h.
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

/// The kinds of contact in a run.
struct ContactKinds {
  bool pairs = false;   // strands meet pair by pair
  bool volume = false;  // some hair meets as a volume

  bool any() const { return pairs || volume; }
};

/// Device order, as RestState.
struct RestContacts {
  ContactParticles particles;  // of the solver
  ContactGraph graph;
  VolumeStrands volume;
  std::optional<ContactParticles> unthinned;  // if dense strands are thinned: all contact particles

  /// The contact particles by which contacts are measured.
  const ContactParticles& allParticles() const { return unthinned ? *unthinned : particles; }

  ContactKinds kinds() const { return {meetPairByPair(volume, graph), volume.count > 0}; }
  /// Warnings for the user, a sentence each: about gaps or raised radii, and about pruning that leaves no
  /// pair.
  std::vector<std::string> warnings() const;
};

/// Cost: that of countOverlaps, mostly.
RestContacts buildRestContacts(const RestState& rest, const ContactSettings& settings);

}  // namespace ringlet
