// ContactWatch: measures contacts over a whole run: how often hairs passed through one another, and the frame
// with the deepest overlaps.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "ringlet/base/archive.h"
#include "ringlet/base/result.h"
#include "ringlet/base/vec3.h"
#include "ringlet/groom/groom.h"
#include "ringlet/measure/contact_quality.h"
#include "ringlet/rest/material.h"
#include "ringlet/scene/settings.h"

namespace ringlet {

/// Give it the state at the start of a run and after every outer step, and tell it where frames end. It works
/// with contacts off as well: it then measures what they would have had to prevent. Cost of a step: some 6 us
/// an edge in dense hair; of a frame: linear in contact particles and overlaps.
class ContactWatch {
 public:
  /// Errors: those of buildRestState. Radii and pruning are those of settings.contacts, on or off.
  static Result<ContactWatch> make(const Groom& groom, const Material& material, const Settings& settings);

  /// positions [m]: groom order. Particles are assumed to move straight: over an interval much longer than a
  /// step this would count crossings where hair moved around.
  void addStep(std::span<const Vec3f> positions);
  /// Marks the last state as the end of a frame. Returns whether it is the worst frame so far.
  bool endFrame();

  const ContactNumbers& numbers() const { return numbers_; }
  /// Archives what was seen so far, for a checkpoint.
  void archive(Archive& archive) {
    archive.list(positions_);
    archive.value(numbers_);
  }
  /// The solver's warnings for these settings (Simulation::warnings).
  const std::vector<std::string>& warnings() const { return ruler_.warnings(); }

 private:
  ContactWatch(ContactRuler ruler, std::span<const std::uint32_t> firstPoint,
               const ContactSettings& settings);

  ContactRuler ruler_;
  std::vector<std::uint32_t> firstPoint_;
  std::vector<std::uint32_t> bundles_;  // of each strand, from 1; empty: there are none
  std::vector<Vec3f> positions_;        // of the step before; empty at first
  ContactNumbers numbers_;
};

}  // namespace ringlet
