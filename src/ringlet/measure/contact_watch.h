// ContactWatch: a whole run seen for what hairs did to each other: how often they went through one another,
// and the frame in which they were deepest in each other.
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

/// Feed the state a run starts from and then every outer step, and say where a frame ends. Works the same
/// with contacts off: it sees what they would have had to do. Cost of a step: some 6 us an edge in dense
/// hair; of a frame: linear in contact particles and overlaps.
class ContactWatch {
 public:
  /// Errors: those of buildRestState. Radii and pruning are those of settings.contacts, on or off.
  static Result<ContactWatch> make(const Groom& groom, const Material& material, const Settings& settings);

  /// positions [m]: groom order. Of a frame much longer than a step, straight ways between its ends would
  /// cross where the hair went round.
  void addStep(std::span<const Vec3f> positions);
  /// The state added last ends a frame. Whether it is the worst so far.
  bool endFrame();

  const ContactNumbers& numbers() const { return numbers_; }
  /// What was seen so far, for a checkpoint.
  void archive(Archive& archive) {
    archive.list(positions_);
    archive.value(numbers_);
  }
  /// What the solver warns of with these settings (Simulation::warnings).
  const std::vector<std::string>& warnings() const { return ruler_.warnings(); }

 private:
  ContactWatch(ContactRuler ruler, std::span<const std::uint32_t> firstPoint,
               const ContactSettings& settings);

  ContactRuler ruler_;
  std::vector<std::uint32_t> firstPoint_;
  std::vector<std::uint32_t> bundles_;  // of each strand, from 1; empty: there are none
  std::vector<Vec3f> positions_;        // of the step before; none at first
  ContactNumbers numbers_;
};

}  // namespace ringlet
