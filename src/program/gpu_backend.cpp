// `--backend gpu`: ringlet::Simulation behind backend.h.
#include <fmt/format.h>

#include <cstdio>
#include <utility>

#include "program/backend.h"
#include "program/compile_note.h"
#include "program/open_device.h"
#include "program/standard_error.h"
#include "program/tuned_shapes.h"
#include "ringlet/solver/shape_plan.h"

namespace ringlet::program {
namespace {

class GpuBackend : public Backend {
 public:
  GpuBackend(ComputeDevice device, Simulation simulation, TunedShapes tuned)
      : device_(std::move(device)),
        simulation_(std::move(simulation)),
        tuned_(std::move(tuned)),
        messagesBefore_(device_.validationMessages().size()) {}

  Status submitFrame(std::span<const HeadPose> stepPoses, std::span<const BodyPose> bodyPoses,
                     std::span<const BodyPose> rootPoses) override {
    return simulation_.submitFrame(stepPoses, bodyPoses, rootPoses);
  }
  Status waitFrame() override { return simulation_.waitFrame(); }
  Status change(const Settings& settings, const Material& material, double /*keysAt*/) override {
    if (Status set = simulation_.setSettings(settings); !set) return set;
    return simulation_.setMaterial(material);
  }
  Status setFields(std::span<const ForceField> fields, std::span<const ForceField> from) override {
    return simulation_.setFields(fields, from);
  }
  Status setGoals(std::span<const Vec3f> places, std::span<const float> strengths, double dampingRatio,
                  std::span<const Vec3f> from) override {
    return simulation_.setGoals(places, strengths, dampingRatio, from);
  }
  Status cut(std::span<const StrandCut> cuts) override { return simulation_.cut(cuts); }
  void framePositions(std::span<Vec3f> all) override { simulation_.framePositions(all); }
  Result<std::vector<Vec3f>> positions() override { return simulation_.positions(); }
  Result<std::vector<std::byte>> checkpoint() override { return simulation_.checkpoint(); }
  Status restore(std::span<const std::byte> checkpoint) override { return simulation_.restore(checkpoint); }
  Result<SimulationReport> report() override { return simulation_.report(); }
  Result<ContactReport> contactReport() override { return simulation_.contactReport(); }
  std::map<std::string, double> stageMilliseconds() const override { return simulation_.stageMilliseconds(); }
  std::optional<HostMilliseconds> hostMilliseconds() const override { return simulation_.hostMilliseconds(); }
  std::size_t rigidStrandCount() const override { return simulation_.rigidStrandCount(); }
  std::vector<std::string> warnings() const override { return simulation_.warnings(); }
  /// The validation layer's too, where it is on.
  std::vector<std::string> deviceMessages() const override {
    std::vector<std::string> all;
    if (!tuned_.warning.empty()) all.push_back(tuned_.warning);
    if (std::string left = whatIsLeftOut(); !left.empty()) all.push_back(std::move(left));
    const std::vector<std::string> messages = device_.validationMessages();
    for (std::size_t i = messagesBefore_; i < messages.size(); ++i)
      all.push_back("Vulkan validation: " + messages[i]);
    return all;
  }
  std::string device() const override { return device_.name(); }
  std::string driver() const override { return device_.driver(); }
  std::string kernel() const override { return simulation_.kernelDescription(); }
  bool isTuned() const override { return !tuned_.costs.empty(); }
  double compileMilliseconds() const override { return simulation_.compileMilliseconds(); }
  std::optional<std::uint64_t> deviceBytes() const override { return simulation_.memory().total(); }

 private:
  ComputeDevice device_;
  Simulation simulation_;
  TunedShapes tuned_;
  std::size_t messagesBefore_;  // of runs on this device before
};

// Where what was measured is true, and there is a choice.
bool mayBeTuned(const BackendInput& input, const KernelChoice& kernel) {
  const ContactKinds kinds{.pairs = input.settings.contacts.on};
  return strandWork(input.settings, input.material, kinds, !input.bodies.empty()) == StrandWork::hairAlone &&
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

Result<std::unique_ptr<Backend>> makeGpuBackend(const BackendInput& input, const GpuChoice& gpu) {
  auto device = gpu.opened ? Result<ComputeDevice>(*gpu.opened) : openGpu(gpu.device);
  if (!device) return device.error();
  TunedShapes tuned;
  if (gpu.usesTuned && mayBeTuned(input, gpu.kernel)) tuned = recallShapes(*device);
  if (tuned.isOutdated && gpu.tells)
    say("ringlet: {} was tuned with another driver or ringlet; `ringlet tune` does it anew\n",
        device->name());
  KernelChoice choice = gpu.kernel;
  const auto groupSize = groupSizeAsked();
  if (!groupSize) return groupSize.error();
  choice.groupSize = *groupSize;
  // Costs are true only of the width they were measured at.
  if (choice.subgroupSize == 0) choice.subgroupSize = static_cast<int>(tuned.subgroupSize);
  if (choice.subgroupSize != static_cast<int>(tuned.subgroupSize)) tuned.costs.clear();
  choice.measured = tuned.costs;
  choice.geometry = input.geometry;
  choice.movingRoots = !input.rootStarts.empty();
  CompileNote note(device->name());
  if (gpu.tells) choice.observer = &note;
  auto simulation = Simulation::create(*device, input.groom, input.material, input.settings,
                                       {.head = input.start,
                                        .oneStepEarlier = input.oneStepEarlier,
                                        .bodies = input.bodies,
                                        .bodyPlaces = input.bodyStarts,
                                        .roots = input.rootStarts,
                                        .rootsEarlier = input.rootsEarlier,
                                        .rootShifts = input.rootShifts},
                                       choice);
  if (!simulation) return simulation.error();
  return std::unique_ptr<Backend>(
      std::make_unique<GpuBackend>(std::move(*device), std::move(*simulation), std::move(tuned)));
}

}  // namespace ringlet::program
