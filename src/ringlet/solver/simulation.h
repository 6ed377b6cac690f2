// Simulation: the hair of one head, on one device. What does not change is its HairAsset's (hair_asset.h),
// which any number of heads share. A frame is one submission, recorded once, which begins by taking the
// head's poses over and ends by bringing positions back.
//
//   submitFrame(1)  submitFrame(2)  waitFrame  framePositions -> 1   submitFrame(3)  waitFrame ...
//   device:         1 ............................ 2 ................................ 3
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/base/vec3.h"
#include "ringlet/groom/groom.h"
#include "ringlet/rest/material.h"
#include "ringlet/scene/body.h"
#include "ringlet/scene/head_pose.h"
#include "ringlet/scene/settings.h"
#include "ringlet/solver/compute_device.h"
#include "ringlet/solver/hair_asset.h"
#include "ringlet/solver/kernel_choice.h"

namespace ringlet {

/// What happened to the numbers since the simulation began.
struct SimulationReport {
  double maxEdgeStretch =
      0;  // longest edge over the groom's edge, over every outer step; infinite once numbers are lost
  double limitedShare = 0;                 // share of edges (times steps) the stretch limit touched
  std::uint64_t nonfinite = 0;             // particles whose position or velocity is not finite now
  std::int64_t firstNonfiniteStrand = -1;  // strand (groom order) and particle of the first of them, or -1
  std::int64_t firstNonfiniteParticle = -1;
  double velocityResidual = 0;  // |r - L v| of the velocity solve over |r| and a step's gravity; worst strand
                                // and step; 0 if not measured
  std::uint64_t degenerateEdges = 0;  // edges (times steps) that had no direction
};

/// What contacts did. Without contacts all is 0.
struct ContactReport {
  std::uint64_t contactParticles = 0;
  std::uint64_t pairsUnpruned = 0;  // of strands, that overlap at rest when enlarged
  std::uint64_t pairs = 0;          // of those, that may touch
  std::uint64_t volumeStrands = 0;  // strands that meet as a volume
  std::uint64_t listed = 0;         // pairs of particles in the lists now
  std::uint64_t contacts = 0;   // and of these, whose springs push; with the time taper, that touch or have
                                // not quite parted
  std::uint64_t pairTests = 0;  // pairs of particles looked at since the simulation began, in all steps
  std::uint64_t rebuilds = 0;   // of the lists
  double momentumError = 0;     // of the last step: |sum of contact momenta| over the sum of their sizes
};

/// Bytes of a simulation's buffers, by what they grow with (docs/memory.md).
struct DeviceMemory {
  std::uint64_t particles = 0;     // state, rest, scratch, what contacts add to a solve
  std::uint64_t strands = 0;       // constants, reports
  std::uint64_t rootPoses = 0;     // of strands that have poses of their own
  std::uint64_t contacts = 0;      // contact particles, their grid, who may touch whom
  std::uint64_t contactLists = 0;  // as long as they have become
  std::uint64_t volume = 0;        // of strands that meet as a volume: particles, grid
  std::uint64_t world = 0;         // the head's poses, bodies with their grids, air
  std::uint64_t frames = 0;        // in flight, in the host's memory: positions read back, poses, air
  std::uint64_t shared = 0;        // of particles and strands: held once for all simulations of an asset

  std::uint64_t total() const {
    return particles + strands + rootPoses + contacts + contactLists + volume + world + frames;
  }
};

/// A head before its first frame. What is left out stands still. Needed until create returns.
struct InitialState {
  HeadPose head{};
  std::optional<HeadPose> oneStepEarlier{};  // one outer step before; the hair moves with the head
  std::span<const Body> bodies{};            // what hair stays out of (Integrator::jacobi only)
  std::span<const BodyPose> bodyPlaces{};    // where they are; without, where they are at t = 0
  // With KernelChoice::movingRoots, strands' own poses (Simulation::stepFrame), now and one outer step
  // before, in groom order; without, they are BodyPose{}. The hair is there, at rest, and moves with them.
  std::span<const BodyPose> roots{}, rootsEarlier{};
  // How far each strand's root (groom order) moves beside the head, when the head's pose has `shift` 1: in
  // the groom's axes [m]. For scenes that bring hair together which is apart at rest.
  std::span<const Vec3d> rootShifts{};
  // Each frame ends with positions in the host's memory. Without, framePositions() may not be asked for, and
  // positions() waits and copies.
  bool readsBack = true;
};

/// Particles' positions and velocities, in groom order, relative to the head's origin and its translation,
/// along world axes.
struct HairState {
  std::vector<Vec3f> positions;   // [m]
  std::vector<Vec3f> velocities;  // [m/s]
};

/// Positions in the device's memory, for a host that draws from there (ComputeDevice::adopt): four floats a
/// particle, x y z 0 [m], relative to the head's origin, along world axes. They are those of the last frame
/// once it was waited for; the host's commands that read them begin with a barrier from compute writes, and
/// are over before the next frame is submitted. The buffer can be bound as storage, texels or vertices, and
/// copied from.
struct DevicePositions {
  void* buffer = nullptr;  // VkBuffer; where handles are 64 bits
  std::uint64_t bytes = 0;
  std::vector<std::uint32_t> particles;  // the groom's index of each particle in the buffer
};

/// Simulation::restore says this of bytes that do not fit.
inline constexpr const char* kForeignCheckpoint =
    "the checkpoint is not of this simulation: it holds another number of bytes";

/// A pair of contact particles in a list, by groom order. With the time taper: what it remembers
/// (ContactSettings); with the distance taper: stiffness 1 where its spring acts in the last iterate, damping
/// 1 where the pair is near enough for either.
struct ListedContact {
  std::uint32_t a = 0, b = 0;  // a < b
  float stiffnessShare = 0, dampingShare = 0;
};

/// For one thread at a time; simulations of one device or asset may each have a thread of their own.
///
/// Strands that float32 cannot hold, and a few that would need far more steps than the others, are carried
/// rigidly by their roots, in their rest shape (rest/rigid_strands.h); warnings() name them. They have
/// positions and velocities as all others do, with roots' poses and shifts, and keep their numbers in groom
/// order; nothing moves them beside their roots: no body, no contact, not setState. SimulationReport counts
/// none of their edges, ContactReport and listedContacts none of their particles, and their taps are 0.
class Simulation {
 public:
  /// The hair of an asset on a head of its own. Fails, with what to do, on bodies that make no sense, or that
  /// the asset was not built for, and when the device lacks memory. Cost: the hair's state in device memory;
  /// kernels are compiled with the first simulation that needs them on a device.
  static Result<Simulation> create(const HairAsset& asset, const InitialState& initial = {});

  /// The same of an asset of its own. Fails where HairAsset::build does, too.
  static Result<Simulation> create(const ComputeDevice& device, const Groom& groom, const Material& material,
                                   const Settings& settings, const InitialState& initial = {},
                                   const KernelChoice& kernel = {});
  Simulation(Simulation&&) noexcept;
  Simulation& operator=(Simulation&&) noexcept;
  ~Simulation();

  /// One frame: settings.stepsPerFrame outer steps; stepPoses[k] is the head's pose at the end of step k.
  /// Where the head jumps (Settings::teleportDistance) hair is carried along and stands still for this frame,
  /// seen from the head; it then goes on as it was. bodyPoses: as bodyPosesOf gives them for these steps;
  /// without, all bodies are the head's. rootPoses[step * strands + strand], groom order, with
  /// KernelChoice::movingRoots: each strand's own pose in the head's frame at the end of each step, which
  /// carries its roots and its root's frame; without, roots stay where they are on the head.
  ///   x_world = head.position + rotate(head.rotation, root.position + rotate(root.rotation, x_groom))
  Status stepFrame(std::span<const HeadPose> stepPoses, std::span<const BodyPose> bodyPoses = {},
                   std::span<const BodyPose> rootPoses = {});
  /// Frames in flight, the same bits as one by one: submitFrame takes what stepFrame does, hands the frame to
  /// the device and returns; waitFrame waits for the oldest that was not waited for, and framePositions then
  /// gives that one's positions (as positions() does), until the kFramesInFlight'th frame after it is
  /// submitted. At most kFramesInFlight may be without their wait, and none when stepFrame is called. All
  /// else here waits for them by itself and tells of the last submitted. With contacts, which may need room
  /// in the middle of a frame, and where the head jumps, submitFrame waits for the frames before.
  static constexpr std::size_t kFramesInFlight = 2;
  Status submitFrame(std::span<const HeadPose> stepPoses, std::span<const BodyPose> bodyPoses = {},
                     std::span<const BodyPose> rootPoses = {});
  Status waitFrame();
  std::vector<Vec3f> framePositions() const;

  /// The oldest frame that recordFrames (hair_frames.h) put into a host's commands is done, as are the host's
  /// own commands that read it; framePositions gives it, as after waitFrame. Without such a frame it does
  /// nothing. Where contact lists had no room for the frame, which happens in a run's first frames, this
  /// submits the rest of it to the device's queue, and waits.
  Status frameIsOver();

  /// The same as stepFrame with the poses interpolated from the last one to `end`.
  Status stepFrame(const HeadPose& end);

  /// Positions in groom order [m], relative to the head's origin, along world axes; world = head().position +
  /// p.
  Result<std::vector<Vec3f>> positions() const;
  /// The same without a way to the host: a buffer for each chunk of strands, good as long as the simulation.
  /// Strands that are carried rigidly are in none.
  std::vector<DevicePositions> devicePositions() const;
  /// Positions and velocities; setState puts them back, of strands that are not rigid, and finds contacts
  /// anew.
  Result<HairState> state() const;
  Status setState(const HairState& state);

  /// All that later frames depend on: hair, contacts, where head, bodies and roots are, what report() counts.
  /// restore() puts it into a simulation that was created with the same arguments on the same device by the
  /// same program: from there on it gives the same bits as if it had stepped all frames itself. The bytes are
  /// not guarded against damage. Cost: 32 bytes a particle to read back, and with contacts their lists.
  Result<std::vector<std::byte>> checkpoint();
  /// Fails, with this simulation spoilt, where the bytes are those of another.
  Status restore(std::span<const std::byte> checkpoint);

  /// Other settings, from the next frame on. What may change: gravity (the rest pose stays balanced against
  /// that of the asset), maxStretch, teleportDistance, loops and iterations; steps a frame, as many as the
  /// asset has at most, none longer than the asset's, and with them frames a second; and of contacts and air
  /// what scene/settings_fields.h says is live. Fails where anything else differs or is out of its range, and
  /// changes nothing then. Cost: frames are recorded anew, some microseconds a dispatch. With contacts it
  /// waits for frames under way; their stiffness and damping have lists made anew.
  Status setSettings(const Settings& settings);
  /// Another material, from the next frame on: other stiffnesses, dampings, blend of the core, variation. Of
  /// the integrator jacobi. Fails where anything else differs, or is out of its range, and changes nothing
  /// then. warnings() are the material's. Cost: it waits for frames under way; constants of this head's own,
  /// 32 bytes a particle and 112 a strand; the first time the asset's rest state twice.
  Status setMaterial(const Material& material);
  /// Other bodies in place of those there are, any number, from the next frame on; `places`: where they are
  /// now in the world, or none: with the head. Fails where create does on bodies, and changes nothing then.
  /// Cost: it waits for frames under way; bodies go to the device anew, with the grids of meshes.
  Status setBodies(std::span<const Body> bodies, std::span<const BodyPose> places = {});
  /// Forces from outside, of hair built with KernelChoice::forces: on each kilogram of every particle, groom
  /// order [m/s^2], along world axes; they add to gravity. They hold in every step of the frames submitted
  /// from now on, until others are set; none act at first. The solve takes them as they are (explicit): no
  /// force that pulls towards a place may be stiffer than about 1/T^2 a metre, T the step. Fails where the
  /// asset was built without. Cost: 16 bytes a particle to write, and to copy
  /// in each frame; 68 of memory.
  Status setForces(std::span<const Vec3f> forces);
  /// As they are now; at first the asset's. Checkpoints hold neither, nor bodies and forces: set them before
  /// restore().
  const Settings& settings() const;
  const Material& material() const;

  const HeadPose& head() const;
  Result<SimulationReport> report() const;
  Result<ContactReport> contactReport() const;
  /// The pairs of particles (groom order, a < b, sorted) the lists hold now, for tests. Empty without
  /// contacts.
  Result<std::vector<ListedContact>> listedContacts() const;
  /// Of the groom's strands.
  std::size_t rigidStrandCount() const;
  /// Things the user should know of (a core spring capped for this step, gravity preload too large, strands
  /// carried rigidly), a sentence each.
  const std::vector<std::string>& warnings() const;
  /// Milliseconds spent on the device, by stage, summed over all frames waited for; by GPU timestamps where
  /// the device has them.
  std::map<std::string, double> stageMilliseconds() const;
  /// Now: a frame in flight may yet make contact lists longer. The driver may take a little more for each of
  /// some dozen buffers.
  DeviceMemory memory() const;
  /// One intermediate of the last step in groom order, four floats a particle (an edge's at its particle i);
  /// `field` is one of layout.h's kTap... Needs KernelChoice::taps.
  Result<std::vector<std::array<float, 4>>> tap(std::uint32_t field) const;
  /// What it took to make the kernels, most of it the driver's compiler [ms]. Part of create. A device
  /// compiles each kernel once, for all simulations on it.
  double compileMilliseconds() const;
  /// What the last frame submitted (or, before it, the first) was recorded as, for tests
  /// (Recorder::recorded).
  std::vector<std::string> recordedFrame() const;
  /// The kernel variants in use, e.g. "lanes 4 x 16 (subgroup 8)".
  std::string kernelDescription() const;

 private:
  friend class HairFrames;
  struct Implementation;
  explicit Simulation(std::unique_ptr<Implementation>);
  std::unique_ptr<Implementation> self_;
};

}  // namespace ringlet
