// HairContacts: how the strands of one head act on each other on a device; empty without contacts.
#pragma once

#include <optional>

#include "ringlet/base/archive.h"
#include "ringlet/base/result.h"
#include "ringlet/rest/rest_contacts.h"
#include "ringlet/solver/contacts/contact_stage.h"
#include "ringlet/solver/contacts/crossing_stage.h"
#include "ringlet/solver/contacts/volume_stage.h"
#include "ringlet/solver/divided/divided_hair.h"
#include "ringlet/solver/simulation.h"

namespace ringlet {

struct HairContacts {
  std::optional<ContactStage> pairs{};       // of strands in contact pair by pair
  std::optional<VolumeStage> volume{};       // of strands in contact as a volume
  std::optional<DividedHair> divided{};      // if other devices step some of the strands
  std::optional<CrossingStage> crossings{};  // if no hair may go through hair
  ContactReport atRest{};

  /// Whether a frame is several submissions, between which the host works.
  bool isInParts() const { return divided || crossings; }
  ContactKinds kinds() const { return {pairs.has_value(), volume.has_value()}; }
  /// Clears contacts and the volume's displacements, after the hair was moved to another state.
  Status forget();
  /// Archives the state of all stages.
  Status archive(Archive& archive);
  /// atRest, completed with the stages' present counts; without the momentum.
  Result<ContactReport> report() const;
};

}  // namespace ringlet
