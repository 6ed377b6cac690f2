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

  // About the whole groom, even if only a part of it is kept (rest/rest_part.h):
  ContactKinds kinds;
  std::size_t particleCount = 0;       // of the solver's contact particles
  float largestRadius = 0;             // of these [m]
  double overlapsPerParticle = 0;      // of strands that may touch, enlarged, over all contact particles
  std::vector<std::uint32_t> inWhole;  // of each contact particle that is kept; none: all are

  /// The contact particles by which contacts are measured.
  const ContactParticles& allParticles() const { return unthinned ? *unthinned : particles; }

  /// Calls tell(other, overlaps at rest) for each strand that meets `strand` pair by pair; if any two may
  /// touch, of 1 overlap.
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

/// The same with any number of threads. Cost: that of countOverlaps, mostly.
RestContacts buildRestContacts(const RestState& rest, const ContactSettings& settings,
                               unsigned threadCount = coreCount());

}  // namespace ringlet
