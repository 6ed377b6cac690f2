// ContactQuality: the depth of overlaps between hairs, and the overlaps that pruning misses, computed from
// positions alone, over all pairs of contact particles.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/base/vec3.h"
#include "ringlet/groom/groom.h"
#include "ringlet/measure/contact_numbers.h"
#include "ringlet/rest/material.h"
#include "ringlet/rest/rest_contacts.h"
#include "ringlet/rest/rest_state.h"
#include "ringlet/scene/settings.h"

namespace ringlet {

/// positions [m]: groom order, as Simulation::positions returns them. Particles that are not finite have no
/// overlaps. Cost: linear in contact particles and overlaps.
ContactQuality measureContacts(const RestState& rest, const RestContacts& contacts,
                               std::span<const Vec3f> positions);

/// The deepest overlap beyond rest of each strand of the groom; 0 for rigid strands. Otherwise as
/// measureContacts.
std::vector<float> overlapOfStrands(const RestState& rest, const RestContacts& contacts,
                                    std::span<const Vec3f> positions);

/// Applies measureContacts to several poses of one groom.
class ContactRuler {
 public:
  /// Errors: those of buildRestState. Radii and pruning are those of settings.contacts, on or off.
  static Result<ContactRuler> make(const Groom& groom, const Material& material, const Settings& settings);

  ContactQuality measure(std::span<const Vec3f> positions) const {
    return measureContacts(rest_, contacts_, positions);
  }
  std::vector<float> overlapOfStrands(std::span<const Vec3f> positions) const {
    return ringlet::overlapOfStrands(rest_, contacts_, positions);
  }
  /// The solver's warnings for these settings (Simulation::warnings).
  const std::vector<std::string>& warnings() const { return rest_.warnings; }

 private:
  ContactRuler(RestState rest, RestContacts contacts)
      : rest_(std::move(rest)), contacts_(std::move(contacts)) {}

  RestState rest_;
  RestContacts contacts_;
};

}  // namespace ringlet
