// Implements what may change of solver/simulation.h between frames.
#include <fmt/format.h>

#include "ringlet/scene/settings_fields.h"
#include "ringlet/solver/simulation_implementation.h"
#include "ringlet/solver/strand_kernels.h"

namespace ringlet {
namespace {

constexpr double kRounding = 1 + 1e-9;  // of two ways to say one step

}  // namespace

Status Simulation::Implementation::checkChange(const Settings& wanted) const {
  if (Status status = checkSettings(wanted, material); !status) return status;
  const Settings& built = asset->settings;
  if (const std::string fixed = fixedDifference(built, wanted); !fixed.empty()) {
    return Error{
        fmt::format("{} is not as the hair's asset was built with it, and does not change while hair moves: "
                    "build another "
                    "asset",
                    fixed)};
  }
  if (wanted.stepsPerFrame > built.stepsPerFrame || wanted.stepSeconds() > built.stepSeconds() * kRounding) {
    return Error{fmt::format(
        "{} steps of 1/{} s a frame: the hair's asset was built for {} of 1/{} s, and takes neither more nor "
        "longer ones",
        wanted.stepsPerFrame, 1 / wanted.stepSeconds(), built.stepsPerFrame, 1 / built.stepSeconds())};
  }
  const auto plan =
      planFrame(ranges, asset->limits, wanted, world.bodyCount(), strandGroupSize(asset->limits));
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
  settings = wanted;
  for (FrameSlot& slot : slots) slot.isRecorded = false;
  return {};
}

Status Simulation::setSettings(const Settings& settings) {
  if (Status status = self_->checkChange(settings); !status) return status;
  return self_->change(settings);
}

const Settings& Simulation::settings() const { return self_->settings; }

}  // namespace ringlet
