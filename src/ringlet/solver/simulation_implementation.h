// The members of a Simulation, for the files that implement it: simulation_frames.cpp, divided_frames.cpp
// and hair_frames.cpp, its frames; simulation_settings.cpp, what changes between them; simulation_cuts.cpp,
// cuts; simulation.cpp, all else.
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
#include "ringlet/solver/contacts/contact_stage.h"
#include "ringlet/solver/contacts/volume_stage.h"
#include "ringlet/solver/divided/divided_hair.h"
#include "ringlet/solver/hair_asset_implementation.h"
#include "ringlet/solver/hair_frames.h"
#include "ringlet/solver/inputs/device_fields.h"
#include "ringlet/solver/inputs/device_forces.h"
#include "ringlet/solver/inputs/device_goals.h"
#include "ringlet/solver/inputs/device_roots.h"
#include "ringlet/solver/inputs/device_world.h"
#include "ringlet/solver/inputs/rigid_hair.h"
#include "ringlet/solver/plan/dispatch_plan.h"
#include "ringlet/solver/plan/frame_plan.h"
#include "ringlet/solver/plan/submission_pace.h"
#include "ringlet/solver/simulation.h"
#include "ringlet/solver/strands/device_groom.h"
#include "ringlet/solver/strands/frame_slot.h"
#include "ringlet/solver/strands/stillness.h"
#include "ringlet/solver/strands/strand_kernels.h"

namespace ringlet {

inline constexpr const char* kBuiltWithoutBodies =
    "the hair's asset was built without bodies; build it with BodyUse::some";

inline constexpr const char* kTooManyNear =
    "more contact particles are near one another than this device can look through; use a smaller contact "
    "radius or volume cell, or fewer strands in one place";

// The head's pose now and one outer step earlier.
struct HeadHistory {
  HeadPose oneStepEarlier, now;

  // Adapts to steps that are this share as long: the velocity stays.
  void rescale(double share) { oneStepEarlier = interpolate(now, oneStepEarlier, share); }

  Vec3d velocity(double T) const { return (now.position - oneStepEarlier.position) / T; }
  Quatd turn() const { return now.rotation * oneStepEarlier.rotation.conjugate(); }
  // Moves to another pose; the velocity relative to the head stays.
  void jump(const HeadPose& to) {
    const Quatd turned = normalized(to.rotation * now.rotation.conjugate());
    const Vec3d step = rotate(turned, now.position - oneStepEarlier.position);
    const Quatd turn = turned * this->turn() * turned.conjugate();
    now = to;
    oneStepEarlier = {to.position - step, normalized(turn.conjugate() * to.rotation), to.shift};
  }
};

// The recording of a frame: its commands, the slot of its input, and its cuts into submissions.
struct FrameRecording {
  gpu::CommandList& list;
  SubmissionPace& pace;
  std::size_t slot = 0;
  // Whose strands its dispatches step: this head's and those behind it in the row; 0: none, another head's
  // do.
  std::uint32_t heads = 1;
  double particleSteps = 0;  // of strands
  bool repeatsStep = false;  // of divided hair: its lists found no room
};

// What parts of divided hair have exchanged in a step, for one that repeats it.
struct PartStep {
  ContactStage::Largest largest{};
  std::optional<ContactStage::Sample> sample{};  // of all parts
};

// This head and some behind it in its row, as a dispatch sees them.
struct BoundHeads {
  HeadBuffers buffers;
  std::vector<gpu::Bindings> bindings;  // one a range
};

// Strand kernels in the shapes of these ranges.
struct StrandKernels {
  const std::vector<StrandRange>& ranges;
  std::vector<std::shared_ptr<const gpu::Kernel>> kernels{};  // one per shape
  std::vector<std::size_t> kernelOf{};                        // of each range
  std::vector<gpu::Bindings> bindings{};                      // one per range
  bool areOfHeads = false;                                    // StrandKernelOptions::heads
  bool areFallen = false;                                     // StrandKernelOptions::falls
  std::map<std::uint32_t, BoundHeads> ofHeads{};              // by how many; of one: bindings

  const gpu::Bindings& bindingsOf(std::uint32_t range, std::uint32_t heads) const {
    return heads > 1 ? ofHeads.at(heads).bindings[range] : bindings[range];
  }

  bool areThere() const { return !kernels.empty(); }
};

// Particles of a strand, device order, that were cut off it together. Its record on the device begins with
// the particle before them, which is the strand's: it is pinned, and the edge from it void.
struct FallenPiece {
  std::uint32_t strand = 0;
  std::uint32_t begin = 0, end = 0;  // particles, counted along the strand
  Quatd restTurn{};                  // of its rest pose: the head's when it was cut
  layout::StrandReport report{};     // while the pieces are put in order

  std::uint32_t count() const { return end - begin; }
};

// What the device has of the pieces of a chunk's strands; their particles are the chunk's.
struct FallenChunk {
  gpu::Buffer strands, reports;
};

struct Simulation::Implementation {
  std::shared_ptr<const HairAsset::Implementation> asset;
  // Of the asset:
  const ComputeDevice& device;
  const RestState& rest;
  const KernelChoice& choice;
  const std::vector<StrandRange>& ranges;

  Settings settings;  // initially the asset's
  Material material;  // likewise
  std::vector<std::string> warnings;
  std::vector<layout::StrandRest> strands{};   // of a head whose roots are shifted; none: the asset's
  std::optional<LiveMaterial> liveMaterial{};  // once it has changed
  bool readsBack = true;                       // after every frame

  HeadHistory head;

  DeviceGroom buffers;
  DeviceWorld world;
  DeviceRoots roots;
  DeviceForces forces;
  DeviceGoals goals;
  DeviceFields fields;
  RigidHair rigidHair;
  SubmissionPace pace;
  StrandKernels strandKernels;
  StrandKernels firstSolveKernels;  // of the first solve of a step; none: the kernels above

  // Once some strands were cut: particles that each keeps, device order; what fell, by strand and from its
  // root on; and how the device has that.
  std::vector<std::uint32_t> kept{};
  std::vector<FallenPiece> pieces{};
  std::vector<FallenChunk> fallenChunks{};
  std::vector<StrandRange> fallenRanges{};
  StrandKernels fallenKernels{fallenRanges};

  std::optional<ContactStage> contacts{};  // of strands that meet pair by pair
  std::optional<VolumeStage> volume{};     // of strands that meet as a volume
  std::optional<DividedHair> divided{};    // if other devices step some of the strands
  ContactReport contactReport{};           // of the rest pose

  Stillness stillness{};
  std::uint64_t stepsDone = 0;
  std::uint64_t stepsBefore = 0;  // steps and seconds before the present step length
  double secondsBefore = 0;
  // Since the simulation began.
  double seconds() const {
    return secondsBefore + static_cast<double>(stepsDone - stepsBefore) * settings.stepSeconds();
  }
  std::map<std::string, double> stageMilliseconds{};
  HostMilliseconds hostMilliseconds{};
  void addTimes(const gpu::Recorder& recorder);  // of its last submission

  double compileMilliseconds = 0;

  // Frame n has slot n % kFramesInFlight: submitted to the device, finished by it, waited for by the caller.
  std::uint64_t submitted = 0, finished = 0, waited = 0;
  bool isReadBack = false;           // the last frame's positions are those on the device
  std::optional<Error> lostFrame{};  // after which the state is unknown
  std::vector<FrameSlot> slots{};    // destroyed first: they wait for commands that use the rest

  // simulation_kernels.cpp
  Status makeKernels();
  StrandKernelOptions kernelOptions() const;
  std::vector<std::size_t> newKernels(const StrandKernels& of, const StrandKernelOptions& options) const;
  Status create(StrandKernels& of, const StrandKernelOptions& options) const;
  Status bindKernels();
  Status bindKernels(StrandKernels& of);
  StrandKernelOptions fallenOptions() const;
  Status bindHeads(std::uint32_t heads);
  gpu::BufferTable bufferTable(std::size_t chunk) const;
  void dispatchNothing(gpu::CommandList& list, const StrandKernels& of,
                       std::span<const std::size_t> newKernels) const;

  // simulation.cpp
  ContactKinds contactKinds() const { return {contacts.has_value(), volume.has_value()}; }
  Status addContacts();
  Status forgetContacts();
  Status placeAtRest();
  Status carryTo(const HeadPose& end);
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
  // Particles of a strand that its root holds.
  std::uint32_t keptOf(std::size_t strand) const {
    return kept.empty() ? rest.strands[strand].particleCount : kept[strand];
  }
  Status checkCuts(std::span<const StrandCut> cuts) const;
  Status cut(std::span<const StrandCut> cuts);
  Status makeFallen();
  Status renewConstants();
  Status uploadFallen(std::span<const layout::StrandRest> strands);
  std::vector<layout::StrandRest> restrict(std::span<layout::StrandRest> strands,
                                           std::span<layout::ParticleRest> particles) const;
  std::vector<std::uint32_t> fallenParticles() const;
  Result<std::vector<layout::StrandReport>> fallenReports() const;

  // simulation_frames.cpp
  layout::StepParameters parametersOf(const StrandKernels& of, const PlannedDispatch& dispatch,
                                      std::uint32_t heads = 1) const;
  bool isJump(std::span<const HeadPose> stepPoses) const {
    RINGLET_ASSERT(stepPoses.size() == static_cast<std::size_t>(settings.stepsPerFrame),
                   "a frame takes one pose per outer step");
    return settings.jumps(length(stepPoses.back().position - head.now.position));
  }
  bool isQuiet(std::span<const HeadPose> stepPoses, std::span<const BodyPose> bodyPoses,
               std::span<const BodyPose> rootPoses) const;
  // Recordings are invalid.
  void forgetRecordings() {
    for (FrameSlot& slot : slots) slot.recorded = FrameSlot::Recorded::nothing;
  }
  // Read-back positions are invalid.
  void forgetFrames() {
    isReadBack = false;
    forgetRecordings();
  }
  FrameSlot& slotOf(std::uint64_t frame) { return slots[frame % kFramesInFlight]; }
  const FrameSlot& waitedSlot();  // of the frame waited for last
  std::vector<PlannedStage> planStages() const;
  void recordInputs(FrameRecording& frame) const;
  void recordEnd(FrameRecording& frame) const;
  Status recordSteps(FrameRecording& frame) const;
  Status recordSolve(FrameRecording& frame, const PlannedStage& stage) const;
  void recordRows(FrameRecording& frame, const PlannedStage& stage) const;
  Status record(FrameRecording& frame, const PlannedStage& stage) const;
  Status record(FrameRecording& frame, std::span<const PlannedStage> stages) const;
  Status recordFrame(FrameRecording& frame) const;
  void dispatchAll(FrameRecording& frame, const StrandKernels& of,
                   std::span<const PlannedDispatch> dispatches) const;
  FrameSlot::Recorded wantedRecording() const {
    return stillness.sleeps() ? FrameSlot::Recorded::sleep : FrameSlot::Recorded::frame;
  }
  bool isRecorded(const FrameSlot& slot) const {
    return slot.recorded == wantedRecording() && (!volume || slot.untilSort == volume->untilSort());
  }
  Status recordSlot(std::size_t slot);
  Status recordRest(std::size_t slot);
  Result<bool> prepareFrame(std::span<const HeadPose> stepPoses, std::span<const BodyPose> bodyPoses,
                            std::span<const BodyPose> rootPoses);
  Status submitFrame(std::span<const HeadPose> stepPoses, std::span<const BodyPose> bodyPoses,
                     std::span<const BodyPose> rootPoses);
  Status finishFrames(std::uint64_t end);
  Status finishFrames() { return finishFrames(submitted); }
  Status runToEnd(std::size_t slot);
  void writePoses(std::size_t slot, std::span<const HeadPose> stepPoses, std::span<const BodyPose> bodyPoses,
                  std::span<const BodyPose> rootPoses);
  Status jumpTo(const HeadPose& end, std::span<const BodyPose> bodyPoses,
                std::span<const BodyPose> rootPoses);

  // divided_frames.cpp
  Status startPart(FrameRecording& frame, gpu::Recorder& recorder, std::span<const PlannedStage> stages);
  Status endPart(gpu::Recorder& recorder);
  Status exchangeStarts(PartStep& now);
  Status exchangeSample(PartStep& now);
  Status exchangeSums(const PlannedStage& stage);
  Status exchange(const PlannedStage& stage, PartStep& now);
  Status runParts(std::size_t slot);

  // hair_frames.cpp
  Status checkFree(const HairFrame& frame) const;
  std::size_t mostHeadsOfDispatch() const;
  bool goesWith(const Implementation& before) const;
  Status recordBeside(gpu::CommandList& list, bool works, std::uint32_t heads);
};

}  // namespace ringlet
