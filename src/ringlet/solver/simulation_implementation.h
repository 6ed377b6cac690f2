// The members of a Simulation, for the files that implement it: its frames in simulation_frames.cpp,
// divided_frames.cpp and hair_frames.cpp; diagnostics.cpp; changes between frames in simulation_settings.cpp;
// cuts in simulation_cuts.cpp; kernels in simulation_kernels.cpp; everything else in simulation.cpp.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "layout/strands.h"
#include "ringlet/base/assert.h"
#include "ringlet/gpu/kernel.h"
#include "ringlet/gpu/recorder.h"
#include "ringlet/rest/live_material.h"
#include "ringlet/rest/rest_state.h"
#include "ringlet/solver/checkpoint_guard.h"
#include "ringlet/solver/contacts/hair_contacts.h"
#include "ringlet/solver/diagnostics.h"
#include "ringlet/solver/hair_asset_implementation.h"
#include "ringlet/solver/hair_frames.h"
#include "ringlet/solver/inputs/fallen_hair.h"
#include "ringlet/solver/inputs/frame_inputs.h"
#include "ringlet/solver/plan/dispatch_plan.h"
#include "ringlet/solver/plan/frame_plan.h"
#include "ringlet/solver/plan/step_clock.h"
#include "ringlet/solver/plan/submission_pace.h"
#include "ringlet/solver/simulation.h"
#include "ringlet/solver/strands/device_groom.h"
#include "ringlet/solver/strands/frames_in_flight.h"
#include "ringlet/solver/strands/hair_kernels.h"
#include "ringlet/solver/strands/stillness.h"
#include "ringlet/solver/strands/strand_kernels.h"

namespace ringlet {

inline constexpr const char* kTooManyNear =
    "more contact particles are near one another than this device can look through; use a smaller contact "
    "radius or volume cell, or fewer strands in one place";

// The recording of a frame: its commands, the slot of its input, and its cuts into submissions.
struct FrameRecording {
  gpu::CommandList& list;
  SubmissionPace& pace;
  std::size_t slot = 0;
  // Number of heads that its dispatches step: this one and those after it in its row; 0: none, since another
  // head's dispatches step this one.
  std::uint32_t heads = 1;
  double particleSteps = 0;  // of strands
  bool repeatsStep = false;  // of divided hair: a step is repeated because lists were too short
};

// What parts of divided hair have exchanged in a step, kept in case a part repeats it.
struct PartStep {
  ContactStage::Largest largest{};
  std::optional<ContactStage::Sample> sample{};  // of all parts
};

// The constants that a head has in place of the asset's.
struct HeadConstants {
  std::vector<layout::StrandRest> strands{};   // if its roots are shifted; empty: the asset's
  std::optional<LiveMaterial> liveMaterial{};  // once the material has changed
  std::vector<std::string> warnings{};
};

// Time that the device and the host have spent since the simulation began.
struct SpentTimes {
  std::map<std::string, double> stages{};  // [ms]
  HostMilliseconds host{};
  double compileMilliseconds = 0;

  // Adds the times of the recorder's last submission.
  void add(const gpu::Recorder& recorder);
};

struct Simulation::Implementation {
  std::shared_ptr<const HairAsset::Implementation> asset;
  std::shared_ptr<const FeaturePlan> featurePlan;  // of the features that this hair uses
  Settings settings;                               // initially the asset's
  Material material;                               // likewise
  HeadConstants constants;
  DeviceGroom buffers;
  FrameInputs inputs;
  SubmissionPace pace;
  HairKernels kernels{
      {&featurePlan->ranges}, {&featurePlan->firstRanges}, {&inputs.get<FallenHair>().ranges()}};
  HairContacts contacts{};
  Stillness stillness{};
  StepClock clock{};
  SpentTimes times{};
  FramesInFlight frames{};  // destroyed first: they wait for commands that use the rest

  const ComputeDevice& device() const { return asset->device; }
  const RestState& rest() const { return asset->rest; }
  const HeadHistory& head() const { return inputs.get<HeadInput>().history(); }
  const FallenHair& fallen() const { return inputs.get<FallenHair>(); }
  std::size_t bodyCount() const { return inputs.get<BodiesInput>().count(); }

  // simulation_kernels.cpp
  Status makeKernels();
  Status prepare(const Features& wanted);
  Status grow();
  StrandKernelOptions kernelOptions() const;
  std::vector<std::size_t> newKernels(const StrandKernels& of, const StrandKernelOptions& options) const;
  Status create(StrandKernels& of, const StrandKernelOptions& options) const;
  Status bindKernels();
  Status bindKernels(StrandKernels& of);
  StrandKernelOptions fallenOptions() const;
  std::string describeKernels() const;
  Status bindHeads(std::uint32_t heads);
  gpu::BufferTable bufferTable(std::size_t chunk) const;
  void dispatchNothing(gpu::CommandList& list, const StrandKernels& of,
                       std::span<const std::size_t> newKernels) const;

  // simulation.cpp
  Status addContacts();
  Status placeAtRest();
  Status carry(const HeadHistory& before);
  // The source for inputs that are made after creation.
  InputSource inputSource() const;
  DeviceGroom& changed();
  Status archive(Archive& archive);
  CheckpointOwner checkpointOwner() const;
  Result<std::vector<Vec3f>> inGroomOrder(DeviceGroom::Field field) const;
  std::vector<Vec3f> positionsOf(const FrameSlot& slot) const;

  // simulation_settings.cpp
  Status checkChange(const Settings& wanted) const;
  Status change(const Settings& wanted);
  Status change(const Material& wanted);
  Status change(std::span<const ForceField> from, std::span<const ForceField> to);
  Status change(std::span<const Body> bodies, std::span<const BodyPose> places);

  // simulation_cuts.cpp
  Status checkCuts(std::span<const StrandCut> cuts) const;
  Status cut(std::span<const StrandCut> cuts);
  Status renewConstants();

  // simulation_frames.cpp
  layout::HairNumbers numbers() const;
  layout::StepParameters parametersOf(const StrandKernels& of, const PlannedDispatch& dispatch,
                                      std::uint32_t heads = 1) const;
  bool isJump(std::span<const HeadPose> stepPoses) const {
    RINGLET_ASSERT(stepPoses.size() == static_cast<std::size_t>(settings.stepsPerFrame),
                   "a frame takes one pose per outer step");
    return settings.jumps(length(stepPoses.back().position - head().now.position));
  }
  const FrameSlot& waitedSlot();  // of the frame waited for last
  std::vector<PlannedStage> planStages() const;
  void recordEnd(FrameRecording& frame) const;
  Status recordSteps(FrameRecording& frame) const;
  Status recordSolve(FrameRecording& frame, const PlannedStage& stage) const;
  void recordRows(FrameRecording& frame, const PlannedStage& stage) const;
  Status record(FrameRecording& frame, const PlannedStage& stage) const;
  Status record(FrameRecording& frame, std::span<const PlannedStage> stages) const;
  Status recordFrame(FrameRecording& frame) const;
  void listCloth(FrameRecording& frame, const StrandKernels& of,
                 std::span<const PlannedDispatch> dispatches) const;
  void dispatchAll(FrameRecording& frame, const StrandKernels& of,
                   std::span<const PlannedDispatch> dispatches) const;
  FrameSlot::Recorded wantedRecording() const {
    return stillness.sleeps() ? FrameSlot::Recorded::sleep : FrameSlot::Recorded::frame;
  }
  bool isRecorded(std::size_t number) const {
    const FrameSlot& slot = frames.slots[number];
    return slot.recorded == wantedRecording() &&
           slot.fieldWork == inputs.get<BodiesInput>().fieldWork(number) &&
           (!contacts.volume || slot.untilSort == contacts.volume->untilSort());
  }
  Status recordSlot(std::size_t slot);
  Status recordRest(std::size_t slot);
  Result<bool> prepareFrame(std::span<const HeadPose> stepPoses, std::span<const BodyPose> bodyPoses,
                            std::span<const BodyPose> rootPoses, BodyPoints bodyPoints);
  Status submitFrame(std::span<const HeadPose> stepPoses, std::span<const BodyPose> bodyPoses,
                     std::span<const BodyPose> rootPoses, BodyPoints bodyPoints);
  Status finishFrames(std::uint64_t end);
  Status finishFrames() { return finishFrames(frames.submitted); }
  Status runToEnd(std::size_t slot);
  void arrive(std::size_t slot);
  Status jump(const FrameContext& frame);

  // divided_frames.cpp
  Status startPart(FrameRecording& frame, gpu::Recorder& recorder, std::span<const PlannedStage> stages);
  Status endPart(gpu::Recorder& recorder);
  Status exchangeStarts(PartStep& now);
  Status exchangeSample(PartStep& now);
  Status exchangeSums(const PlannedStage& stage);
  Status exchange(const PlannedStage& stage, PartStep& now);
  Status keepApart(std::uint32_t step);
  Status runParts(std::size_t slot);

  // hair_frames.cpp
  Status checkFree(const HairFrame& frame) const;
  std::size_t mostHeadsOfDispatch() const;
  bool goesWith(const Implementation& before) const;
  Status recordBeside(gpu::CommandList& list, bool works, std::uint32_t heads);
};

}  // namespace ringlet
