// RestContacts: contact particles and the pairs of strands that may touch, found once in the rest pose. The
// solver, the measures and the reports of contacts use it. Iben et al. 2012, section 4. Mirrored by
// reference/rest_contacts.h.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "ringlet/base/in_parallel.h"
#include "ringlet/rest/contact_graph.h"
#include "ringlet/rest/contact_particles.h"
#include "ringlet/rest/rest_state.h"
#include "ringlet/rest/volume_strands.h"
#include "ringlet/scene/contact_settings.h"

namespace ringlet {

/// The kinds of contact in a run.
struct ContactKinds {
  bool pairs = false;   // strands touch pair by pair
  bool volume = false;  // some hair is a volume

  bool any() const { return pairs || volume; }
};

/// Device order, as RestState.
struct RestContacts {
  ContactParticles particles;  // of the solver
  ContactGraph graph;
  VolumeStrands volume;
  std::optional<ContactParticles> unthinned;  // if dense strands are thinned: all contact particles

  // About the whole groom, even if only a part of it is kept (rest/rest_part.h):
  ContactKinds kinds;
  std::size_t particleCount = 0;       // number of the solver's contact particles
  float largestRadius = 0;             // of the solver's contact particles [m]
  double overlapsPerParticle = 0;      // enlarged overlaps of strands that may touch, per contact particle
  std::vector<std::uint32_t> inWhole;  // index in the whole groom of each contact particle that is kept;
                                       // empty: all are kept

  /// The contact particles with which contacts are measured.
  const ContactParticles& allParticles() const { return unthinned ? *unthinned : particles; }

  /// Calls tell(other, overlaps at rest) for each strand that `strand` may touch pair by pair; with 1 overlap
  /// if any two may touch.
  template <class Tell>
  void eachPartner(std::uint32_t strand, const Tell& tell) const {
    if (!kinds.pairs) return;
    const auto& groups = volume.groups;
    const auto meet = [&](std::uint32_t other, std::uint32_t count) {
      if (other != strand && !(volume.hasGroups() && groups[strand] == groups[other])) tell(other, count);
    };
    if (graph.everyPair) {
      for (std::uint32_t other = 0; other < groups.size(); ++other) meet(other, 1);
    } else {
      for (std::uint32_t k = graph.firstNeighbour[strand]; k < graph.firstNeighbour[strand + 1]; ++k)
        meet(graph.neighbours[k], graph.counts[k]);
    }
  }

  /// Warnings for the user, a sentence each: about gaps or raised radii, and about pruning that leaves no
  /// pair.
  std::vector<std::string> warnings() const;
};

/// The result does not depend on threadCount. Cost: mostly that of countOverlaps.
RestContacts buildRestContacts(const RestState& rest, const ContactSettings& settings,
                               unsigned threadCount = coreCount());

}  // namespace ringlet
