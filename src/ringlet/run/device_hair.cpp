// Implements run/device_hair.h.
#include "ringlet/run/device_hair.h"

#include <utility>

#include "ringlet/run/scene_run.h"
#include "ringlet/solver/diagnostics.h"

namespace ringlet {
namespace {

class DeviceHair : public SceneHair {
 public:
  DeviceHair(const DeviceHairChoice& choice, Simulation simulation, bool isStepByStep)
      : device_(choice.device),
        messages_(choice.messages),
        isTuned_(!choice.kernel.measured.empty()),
        simulation_(std::move(simulation)),
        isStepByStep_(isStepByStep),
        messagesBefore_(device_.validationMessages().size()) {}

  Status submit(const SceneFrame& frame) override {
    if (Status prepared = prepare(frame, simulation_, isStepByStep_); !prepared) return prepared;
    return simulation_.submitFrame(frame.heads, frame.bodies, frame.roots, frame.bodyPoints());
  }
  Status wait() override { return simulation_.waitFrame(); }
  void framePositions(std::span<Vec3f> all) override { simulation_.framePositions(all); }
  Result<std::vector<Vec3f>> positions() override { return simulation_.positions(); }
  Result<std::vector<std::byte>> checkpoint() override { return simulation_.checkpoint(); }
  Status restore(const SceneFrames& frames, int frame, std::span<const std::byte> checkpoint) override {
    if (Status taken = catchUp(frames, frame, simulation_, isStepByStep_); !taken) return taken;
    return simulation_.restore(checkpoint);
  }
  Result<HairReports> reports() override {
    const auto hair = simulation_.report();
    if (!hair) return hair.error();
    const auto contacts = simulation_.contactReport();
    if (!contacts) return contacts.error();
    return HairReports{*hair, *contacts};
  }
  HairTimes times() const override {
    return {Diagnostics(simulation_).stageMilliseconds(), Diagnostics(simulation_).hostMilliseconds()};
  }
  std::vector<StageSpan> frameStages() const override { return Diagnostics(simulation_).frameStages(); }
  // Also contains the messages of the validation layer, if it is on.
  HairFacts facts() const override {
    HairFacts facts{.device = device_.name(),
                    .driver = device_.driver(),
                    .kernel = Diagnostics(simulation_).kernels(),
                    .rigidStrandCount = Diagnostics(simulation_).rigidStrandCount(),
                    .isTuned = isTuned_,
                    .compileMilliseconds = Diagnostics(simulation_).compileMilliseconds(),
                    .deviceBytes = Diagnostics(simulation_).memory().total(),
                    .warnings = simulation_.warnings(),
                    .messages = messages_};
    const std::vector<std::string> said = device_.validationMessages();
    for (std::size_t i = messagesBefore_; i < said.size(); ++i)
      facts.messages.push_back("Vulkan validation: " + said[i]);
    return facts;
  }

 private:
  ComputeDevice device_;
  std::vector<std::string> messages_;
  bool isTuned_;
  Simulation simulation_;
  bool isStepByStep_;
  std::size_t messagesBefore_;  // of earlier runs on this device
};

}  // namespace

Result<Simulation> makeSimulation(const SceneHairInput& input, DeviceHairChoice choice) {
  const ScenePlaces start = input.frames.placesAt(input.frames.first());
  choice.kernel.geometry = input.scene.geometry.get();
  choice.kernel.residual = input.measuresResidual;
  choice.kernel.rest = input.rest;
  auto hair = Simulation::create(choice.device, input.scene.groom, input.scene.material, input.settings(),
                                 stateOf(start, input.scene), kernelOf(input.scene, choice.kernel));
  if (!hair) return hair;
  if (Status begun = beginShot(start, input.scene, *hair); !begun) return begun.error();
  return hair;
}

Result<std::unique_ptr<SceneHair>> makeDeviceHair(const SceneHairInput& input, DeviceHairChoice choice) {
  auto simulation = makeSimulation(input, choice);
  if (!simulation) return simulation.error();
  return std::unique_ptr<SceneHair>(
      std::make_unique<DeviceHair>(choice, std::move(*simulation), input.isStepByStep));
}

}  // namespace ringlet
