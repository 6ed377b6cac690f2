// Implements the changes between frames of solver/simulation.h.
#include <fmt/format.h>

#include <utility>

#include "layout/strands.h"
#include "ringlet/rest/material_parameters.h"
#include "ringlet/scene/outside_numbers.h"
#include "ringlet/scene/settings_fields.h"
#include "ringlet/solver/simulation_implementation.h"
#include "ringlet/solver/strands/strand_kernels.h"

namespace ringlet {
namespace {

constexpr double kRounding = 1 + 1e-9;  // tolerance for two ways to compute one step length

}  // namespace

Status Simulation::Implementation::checkChange(const Settings& wanted) const {
  if (Status status = checkSettings(wanted, material); !status) return status;
  if (!rest().elsewhere.empty() || contacts.divided) {
    if (Status status = checkPart(wanted, asset->choice.link); !status) return status;
  }
  const Settings& built = asset->settings;
  if (const std::string fixed = fixedDifference(built, wanted); !fixed.empty()) {
    return Error{fmt::format(
        "{} is not as the hair's asset was built with it, and does not change while hair moves: build "
        "another asset",
        fixed)};
  }
  if (wanted.stepsPerFrame > built.stepsPerFrame || wanted.stepSeconds() > built.stepSeconds() * kRounding) {
    return Error{fmt::format(
        "{} steps of 1/{} s a frame: the hair's asset was built for {} of 1/{} s, and takes neither more nor "
        "longer ones",
        wanted.stepsPerFrame, 1 / wanted.stepSeconds(), built.stepsPerFrame, 1 / built.stepSeconds())};
  }
  const auto plan =
      planFrame(featurePlan->ranges, {asset->limits, featurePlan->groupSize}, wanted, bodyCount());
  return plan ? Status{} : plan.error();
}

Status Simulation::Implementation::change(const Settings& wanted) {
  if (contacts.kinds().any()) {
    if (Status status = finishFrames(); !status) return status;
  }
  if (contacts.pairs) {
    if (Status status = contacts.pairs->setSettings(wanted); !status) return status;
  }
  if (contacts.volume) {
    if (Status status = contacts.volume->setSettings(wanted); !status) return status;
  }
  const double share = wanted.stepSeconds() / settings.stepSeconds();
  if (share != 1) clock.endLength(settings.stepSeconds());
  for (FrameInput* input : inputs.each()) {
    if (share != 1) input->rescale(share);
    input->setSettings(settings, wanted);
  }
  settings = wanted;
  stillness.wake();
  frames.forgetRecordings();
  return {};
}

Status Simulation::Implementation::change(const Material& wanted) {
  if (Status status = finishFrames(); !status) return status;
  if (!constants.liveMaterial) {
    auto made = LiveMaterial::create(rest(), asset->material, asset->settings);
    if (!made) return made.error();
    constants.liveMaterial = std::move(*made);
  }
  const Material before = std::exchange(material, wanted);
  Status status = renewConstants();
  if (!status) material = before;
  return status;
}

Status Simulation::Implementation::change(std::span<const Body> bodies, std::span<const BodyPose> places) {
  const auto plan =
      planFrame(featurePlan->ranges, {asset->limits, featurePlan->groupSize}, settings, bodies.size());
  if (!plan) return plan.error();
  if (Status status = finishFrames(); !status) return status;
  auto made = BodiesInput::create(inputSource(), bodies, places, head().now);
  if (!made) return made.error();
  const BodiesInput before = std::exchange(inputs.get<BodiesInput>(), std::move(*made));
  const BodiesInput& now = inputs.get<BodiesInput>();
  stillness.wake();
  frames.forgetRecordings();
  const bool same = before.bends() == now.bends() && before.isCloth() == now.isCloth();
  return same ? bindKernels() : makeKernels();
}

Status Simulation::setBodies(std::span<const Body> bodies, std::span<const BodyPose> places) {
  for (const Body& body : bodies) {
    if (Status status = checkBody(body); !status) return status;
  }
  if (Status status = self_->prepare({.bodies = !bodies.empty()}); !status) return status;
  return self_->change(bodies, places);
}

Status Simulation::setMaterial(const Material& material) {
  const Implementation& self = *self_;
  if (material == self.material) return {};
  if (self.settings.integrator != Integrator::jacobi)
    return Error{"a material changes while hair moves with the integrator jacobi only"};
  if (Status status = checkMaterial(material); !status) return status;
  if (const std::string fixed = fixedDifference(self.asset->material, material); !fixed.empty()) {
    return Error{fmt::format(
        "the material's {} is not as the hair's asset was built with it, and does not change while hair "
        "moves: build another asset",
        fixed)};
  }
  return self_->change(material);
}

Status Simulation::setSettings(const Settings& settings) {
  if (settings == self_->settings) return {};
  if (Status status = self_->checkChange(settings); !status) return status;
  return self_->change(settings);
}

Status Simulation::setForces(std::span<const Vec3f> forces) {
  RINGLET_ASSERT(forces.size() == self_->rest().groomParticleCount, "every particle has a force");
  if (Status status = checkEach(forces, "force", kOutsideForce, "m/s^2"); !status) return status;
  if (Status status = self_->prepare({.forces = true}); !status) return status;
  self_->inputs.get<ForcesInput>().set(forces);
  self_->stillness.wake();
  return {};
}

Status Simulation::setGoals(std::span<const Vec3f> places, std::span<const float> strengths,
                            double dampingRatio, std::span<const Vec3f> from) {
  RINGLET_ASSERT(places.size() == self_->rest().groomParticleCount && strengths.size() == places.size() &&
                     (from.empty() || from.size() == places.size()),
                 "every particle has a place and a strength");
  if (Status status = checkGoals(places, strengths, dampingRatio, from); !status) return status;
  if (Status status = self_->prepare({.goals = true}); !status) return status;
  self_->inputs.get<GoalsInput>().set(places, strengths, dampingRatio, from);
  self_->stillness.wake();
  return {};
}

Status Simulation::Implementation::change(std::span<const ForceField> from, std::span<const ForceField> to) {
  FieldsInput& fields = inputs.get<FieldsInput>();
  if (!std::ranges::equal(from, fields.now())) stillness.wake();
  if (!fields.hasRoomFor(to)) {
    if (Status status = finishFrames(); !status) return status;
    auto made = FieldsInput::create(inputSource(), to);
    if (!made) return made.error();
    fields = std::move(*made);
    frames.forgetRecordings();
    if (Status status = bindKernels(); !status) return status;
  }
  fields.set(from, to);
  return {};
}

Status Simulation::setFields(std::span<const ForceField> fields, std::span<const ForceField> from) {
  RINGLET_ASSERT(from.empty() || from.size() == fields.size(), "every field has a start");
  for (const std::span<const ForceField> some : {fields, from}) {
    for (const ForceField& field : some) {
      if (Status checked = checkForceField(field); !checked) return checked;
    }
  }
  if (Status status = self_->prepare({.fields = !fields.empty()}); !status) return status;
  return self_->change(from.empty() ? fields : from, fields);
}

Status Simulation::prepare(const Features& features) { return self_->prepare(features); }

const Settings& Simulation::settings() const { return self_->settings; }
const Material& Simulation::material() const { return self_->material; }

}  // namespace ringlet
