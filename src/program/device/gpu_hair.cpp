// Implements gpu_hair.h.
#include "program/device/gpu_hair.h"

#include <utility>
#include <vector>

#include "program/cli/standard_error.h"
#include "program/device/open_device.h"
#include "ringlet/run/divided_hair.h"
#include "ringlet/solver/plan/shape_plan.h"

namespace ringlet::program {
namespace {

// Whether the measurements apply to this hair, and the shape is not prescribed.
bool mayBeTuned(const SceneHairInput& input, const KernelChoice& kernel) {
  const Settings settings = input.settings();
  const ContactKinds kinds{.pairs = settings.contacts.on};
  return strandWork(settings, input.scene.material, kinds, !input.scene.bodies.empty()) ==
             StrandWork::hairAlone &&
         (kernel.form == KernelChoice::Form::automatic || kernel.form == KernelChoice::Form::lanes) &&
         (kernel.lanes == 0 || kernel.particlesPerLane == 0);
}

}  // namespace

Result<ComputeDevice> openGpu(const std::string& device) {
  auto opened = openDevice(device);
  if (!opened)
    return Error{opened.error().message + " (`--backend reference` runs without Vulkan, slowly)",
                 opened.error().fault};
  return opened;
}

Result<std::unique_ptr<GpuChoice>> GpuChoice::make(const SceneHairInput& input, const DeviceChoice& choice,
                                                   const std::string& device, bool isTold) {
  std::unique_ptr<GpuChoice> made(new GpuChoice);
  auto opened = choice.opened ? Result<ComputeDevice>(*choice.opened) : openGpu(device);
  if (!opened) return opened.error();
  TunedShapes& tuned = made->tuned_;
  if (choice.usesTuned && mayBeTuned(input, choice.kernel)) tuned = recallShapes(*opened);
  if (tuned.isOutdated && isTold)
    say("ringlet: {} was tuned with another driver or ringlet; `ringlet tune` does it anew\n",
        opened->name());
  KernelChoice kernel = choice.kernel;
  const auto groupSize = groupSizeAsked();
  if (!groupSize) return groupSize.error();
  kernel.groupSize = *groupSize;
  // Costs apply only to the width at which they were measured.
  if (kernel.subgroupSize == 0) kernel.subgroupSize = static_cast<int>(tuned.subgroupSize);
  if (kernel.subgroupSize != static_cast<int>(tuned.subgroupSize)) tuned.costs.clear();
  kernel.measured = tuned.costs;
  made->note_ = std::make_unique<CompileNote>(opened->name());
  if (isTold) kernel.observer = made->note_.get();
  made->choice_ = DeviceHairChoice{std::move(*opened), kernel};
  if (!tuned.warning.empty()) made->choice_->messages.push_back(tuned.warning);
  if (std::string left = whatIsLeftOut(); !left.empty()) made->choice_->messages.push_back(std::move(left));
  return made;
}

Result<std::unique_ptr<SceneHair>> makeGpuHair(const SceneHairInput& input, const DeviceChoice& choice,
                                               bool isTold) {
  const std::vector<std::string> devices =
      choice.devices.empty() ? std::vector{choice.device} : choice.devices;
  std::vector<std::unique_ptr<GpuChoice>> kept;
  std::vector<DeviceHairChoice> choices;
  for (const std::string& device : devices) {
    auto made = GpuChoice::make(input, choice, device, isTold);
    if (!made) return made.error();
    choices.push_back((*made)->choice());
    kept.push_back(std::move(*made));
  }
  return makeDividedHair(input, std::move(choices));
}

}  // namespace ringlet::program
