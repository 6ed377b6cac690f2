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

constexpr double kRounding = 1 + 1e-9;  // between two expressions for one step length

}  // namespace

Status Simulation::Implementation::checkChange(const Settings& wanted) const {
  if (Status status = checkSettings(wanted, material); !status) return status;
  if (!rest.elsewhere.empty() || divided) {
    if (Status status = checkPart(wanted, choice.link); !status) return status;
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
  const auto plan = planFrame(ranges, asset->limits, wanted, world.bodyCount(), asset->groupSize);
  return plan ? Status{} : plan.error();
}

Status Simulation::Implementation::change(const Settings& wanted) {
  if (contacts) {
    if (Status status = finishFrames(); !status) return status;
    if (Status status = contacts->setSettings(wanted); !status) return status;
  }
  if (volume) volume->setSettings(wanted);
  const double share = wanted.stepSeconds() / settings.stepSeconds();
  if (share != 1) {
    secondsBefore = seconds();
    stepsBefore = stepsDone;
    head.rescale(share);
    roots.setStepSeconds(wanted.stepSeconds());
    rigidHair.rescale(share);
  }
  world.setSettings(wanted);
  if (asset->goal && wanted.goal != settings.goal)
    goals.set(asset->goal->places, strengthsOf(*asset->goal, wanted.goal), wanted.goal.damping, {});
  settings = wanted;
  stillness.wake();
  forgetRecordings();
  return {};
}

Status Simulation::Implementation::change(const Material& wanted) {
  if (Status status = finishFrames(); !status) return status;
  if (!liveMaterial) {
    auto made = LiveMaterial::create(rest, asset->material, asset->settings);
    if (!made) return made.error();
    liveMaterial = std::move(*made);
  }
  const Material before = std::exchange(material, wanted);
  Status status = renewConstants();
  if (!status) material = before;
  return status;
}

Status Simulation::Implementation::change(std::span<const Body> bodies, std::span<const BodyPose> places) {
  const auto plan = planFrame(ranges, asset->limits, settings, bodies.size(), asset->groupSize);
  if (!plan) return plan.error();
  if (Status status = finishFrames(); !status) return status;
  // For the largest number of steps per frame, and the present air.
  Settings largest = settings;
  largest.stepsPerFrame = asset->settings.stepsPerFrame;
  auto made = DeviceWorld::create(device.gpu(), bodies, largest, head.now, kFramesInFlight);
  if (!made) return made.error();
  made->setSettings(settings);
  if (!places.empty()) made->placeBodies(places);
  world = std::move(*made);
  stillness.wake();
  forgetRecordings();
  return bindKernels();
}

Status Simulation::setBodies(std::span<const Body> bodies, std::span<const BodyPose> places) {
  RINGLET_ASSERT(places.empty() || places.size() == bodies.size(), "every body has a place");
  if (self_->asset->bodies == BodyUse::none && !bodies.empty()) return Error{kBuiltWithoutBodies};
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
  RINGLET_ASSERT(forces.size() == self_->rest.groomParticleCount, "every particle has a force");
  if (!self_->forces.areThere()) {
    return Error{
        "the hair's asset was built without forces from outside; build it with KernelChoice::forces"};
  }
  if (Status status = checkEach(forces, "force", kOutsideForce, "m/s^2"); !status) return status;
  self_->forces.set(forces);
  self_->stillness.wake();
  return {};
}

Status Simulation::setGoals(std::span<const Vec3f> places, std::span<const float> strengths,
                            double dampingRatio, std::span<const Vec3f> from) {
  RINGLET_ASSERT(places.size() == self_->rest.groomParticleCount && strengths.size() == places.size() &&
                     (from.empty() || from.size() == places.size()),
                 "every particle has a place and a strength");
  if (!self_->goals.areThere())
    return Error{"the hair's asset was built without goals; build it with KernelChoice::goals"};
  if (Status status = checkGoals(places, strengths, dampingRatio, from); !status) return status;
  self_->goals.set(places, strengths, dampingRatio, from);
  self_->stillness.wake();
  return {};
}

Status Simulation::Implementation::change(std::span<const ForceField> from, std::span<const ForceField> to) {
  if (!std::ranges::equal(from, fields.now())) stillness.wake();
  if (!fields.hasRoomFor(to)) {
    if (Status status = finishFrames(); !status) return status;
    auto made = DeviceFields::create(device.gpu(), to, asset->settings.stepsPerFrame, kFramesInFlight);
    if (!made) return made.error();
    fields = std::move(*made);
    forgetRecordings();
    if (Status status = bindKernels(); !status) return status;
  }
  fields.set(from, to);
  return {};
}

Status Simulation::setFields(std::span<const ForceField> fields, std::span<const ForceField> from) {
  RINGLET_ASSERT(from.empty() || from.size() == fields.size(), "every field has a start");
  if (!self_->choice.fields)
    return Error{"the hair's asset was built without fields; build it with KernelChoice::fields"};
  for (const std::span<const ForceField> some : {fields, from}) {
    for (const ForceField& field : some) {
      if (Status checked = checkForceField(field); !checked) return checked;
    }
  }
  return self_->change(from.empty() ? fields : from, fields);
}

const Settings& Simulation::settings() const { return self_->settings; }
const Material& Simulation::material() const { return self_->material; }

}  // namespace ringlet
