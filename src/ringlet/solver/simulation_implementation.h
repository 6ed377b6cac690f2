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
#include "ringlet/solver/contact_stage.h"
#include "ringlet/solver/device_fields.h"
#include "ringlet/solver/device_forces.h"
#include "ringlet/solver/device_goals.h"
#include "ringlet/solver/device_groom.h"
#include "ringlet/solver/device_roots.h"
#include "ringlet/solver/device_world.h"
#include "ringlet/solver/dispatch_plan.h"
#include "ringlet/solver/divided_hair.h"
#include "ringlet/solver/frame_slot.h"
#include "ringlet/solver/hair_asset_implementation.h"
#include "ringlet/solver/hair_frames.h"
#include "ringlet/solver/rigid_hair.h"
#include "ringlet/solver/simulation.h"
#include "ringlet/solver/stillness.h"
#include "ringlet/solver/strand_kernels.h"
#include "ringlet/solver/submission_pace.h"
#include "ringlet/solver/volume_stage.h"

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
  std::map<std::uint32_t, BoundHeads> ofHeads{};              // by how many; of one: bindings

  const gpu::Bindings& bindingsOf(std::uint32_t range, std::uint32_t heads) const {
    return heads > 1 ? ofHeads.at(heads).bindings[range] : bindings[range];
  }

  bool areThere() const { return !kernels.empty(); }
};

// What was cut off at once, and where it stands in the groom's order.
struct FallenHair {
  struct Run {
    std::uint32_t first, count;
  };
  Simulation hair;
  std::vector<Run> runs;

  // Its values in their places among all.
  void put(std::span<const Vec3f> values, std::span<Vec3f> all) const {
    for (const Run& run : runs)
      std::ranges::copy(values.subspan(run.first, run.count), all.begin() + run.first);
  }
};

// Of a strand, the particles that are simulated.
struct StrandPart {
  std::uint32_t begin = 0, end = 0;
};

// What falls feels no head and has no goals.
Material fallenMaterial(Material material);
Settings fallenSettings(Settings settings);

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

  std::vector<StrandPart> parts{};   // of strands, device order, once some were cut; none: all of them
  bool falls = false;                // what was cut off; each part begins with the particle before it
  Quatd restTurn{};                  // of its rest pose, when it was cut
  std::vector<FallenHair> fallen{};  // what was cut off this hair, cut by cut

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
  Status bindHeads(std::uint32_t heads);
  gpu::BufferTable bufferTable(std::size_t chunk) const;
  void dispatchNothing(gpu::CommandList& list, const StrandKernels& of,
                       std::span<const std::size_t> newKernels) const;

  // simulation.cpp
  bool isHere(std::size_t strand) const { return asset->isHere.empty() || asset->isHere[strand]; }
  ContactKinds contactKinds() const { return {contacts.has_value(), volume.has_value()}; }
  Status addContacts();
  Status forgetContacts();
  Status placeAtRest();
  Status carryTo(const HeadPose& end);
  DeviceGroom& changed();
  Status archive(Archive& archive);
  Result<std::vector<Vec3f>> inGroomOrder(DeviceGroom::Field field) const;

  // simulation_settings.cpp
  Status checkChange(const Settings& wanted) const;
  Status change(const Settings& wanted);
  Status change(const Material& wanted);
  Status change(std::span<const ForceField> from, std::span<const ForceField> to);
  Status change(std::span<const Body> bodies, std::span<const BodyPose> places);

  // simulation_cuts.cpp
  template <class Work>
  Status ofFallen(Work&& work) {
    for (FallenHair& each : fallen) {
      if (Status status = work(each.hair); !status) return status;
    }
    return {};
  }
  // Of a strand as the device has it, which particle is the first, and how many edges it has.
  std::uint32_t firstOf(std::size_t strand) const { return falls ? parts[strand].begin - 1 : 0; }
  std::uint32_t edgeCountOf(std::size_t strand) const {
    if (parts.empty()) return rest.strands[strand].particleCount - 1;
    return parts[strand].end - parts[strand].begin - 1;
  }
  Status checkCuts(std::span<const StrandCut> cuts) const;
  Result<FallenHair> fall(std::span<const StrandCut> cuts, const HairState& state) const;
  Status takeParts(std::vector<StrandPart> wanted);
  void restrict(std::span<layout::StrandRest> strands, std::span<layout::ParticleRest> particles) const;

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
  void beginFrame(FrameRecording& frame) const;
  void recordEnd(FrameRecording& frame) const;
  Status recordFrame(FrameRecording& frame) const;
  void recordGrid(FrameRecording& frame, std::uint32_t step) const;
  void recordFirstMeeting(FrameRecording& frame, std::uint32_t step) const;
  void recordBrought(FrameRecording& frame, std::uint32_t step, bool isFirst) const;
  void recordVolume(FrameRecording& frame, std::uint32_t step, bool isFirst) const;
  void recordNextMeeting(FrameRecording& frame, std::uint32_t step) const;
  Status recordContactFrame(FrameRecording& frame, std::uint32_t firstStep, bool predictFirst) const;
  Status recordPass(FrameRecording& frame, const SolvePass& pass) const;
  void dispatchAll(FrameRecording& frame, const StrandKernels& of,
                   std::span<const PlannedDispatch> dispatches) const;
  FrameSlot::Recorded wantedRecording() const {
    return stillness.sleeps() ? FrameSlot::Recorded::sleep : FrameSlot::Recorded::frame;
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
  template <class Work>
  Status submitPart(FrameRecording& frame, gpu::Recorder& recorder, std::optional<DividedHair::Rows> in,
                    std::optional<DividedHair::Rows> out, const Work& work);
  template <class Solve>
  Status meetFirst(FrameRecording& frame, gpu::Recorder& recorder, std::uint32_t step, const Solve& solve,
                   std::optional<DividedHair::Rows> out);
  Status runParts(std::size_t slot);

  // hair_frames.cpp
  Status checkFree(const HairFrame& frame) const;
  std::size_t mostHeadsOfDispatch() const;
  bool goesWith(const Implementation& before) const;
  Status recordBeside(gpu::CommandList& list, bool works, std::uint32_t heads);
};

}  // namespace ringlet
