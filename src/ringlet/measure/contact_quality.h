// ContactQuality: the depth of overlaps between hairs, and the overlaps that pruning misses, computed from
// positions alone, over all pairs of contact particles.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/base/vec3.h"
#include "ringlet/groom/groom.h"
#include "ringlet/rest/material.h"
#include "ringlet/rest/rest_contacts.h"
#include "ringlet/rest/rest_state.h"
#include "ringlet/scene/settings.h"

namespace ringlet {

/// Over all pairs of contact particles of different strands that are nearer than R, the sum of their radii. A
/// contact's rest length r0 is R, or their distance at rest where that is less: what overlaps at rest may.
/// The overlap beyond rest is max(0, r0 - distance) / R.
struct ContactQuality {
  std::uint64_t overlapping = 0;    // how many are nearer than R
  double rawRecall = 1;             // share of them whose strands may touch; 1 where there are none
  double overlapBeyondRestSum = 0;  // of all of them, allowed or not
  double deepestOverlap = 0;        // largest of all; 1: two centres in one place
};

/// positions [m]: groom order, as Simulation::positions returns them. Particles that are not finite overlap
/// nothing. Cost: linear in contact particles and overlaps.
ContactQuality measureContacts(const RestState& rest, const RestContacts& contacts,
                               std::span<const Vec3f> positions);

/// The deepest overlap beyond rest of each strand of the groom; 0 of those that are carried rigidly.
/// Otherwise as measureContacts.
std::vector<float> overlapOfStrands(const RestState& rest, const RestContacts& contacts,
                                    std::span<const Vec3f> positions);

/// measureContacts of one groom, pose after pose.
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
  /// What the solver warns of with these settings (Simulation::warnings).
  const std::vector<std::string>& warnings() const { return rest_.warnings; }

 private:
  ContactRuler(RestState rest, RestContacts contacts)
      : rest_(std::move(rest)), contacts_(std::move(contacts)) {}

  RestState rest_;
  RestContacts contacts_;
};

}  // namespace ringlet
