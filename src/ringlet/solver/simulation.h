// Simulation: the hair of one head, on one device. All constants belong to its HairAsset (hair_asset.h),
// which any number of heads share. A frame is one submission, recorded once: it copies the head's poses to
// the device, steps, and copies positions back.
//
//   submitFrame(1)  submitFrame(2)  waitFrame  framePositions -> 1   submitFrame(3)  waitFrame ...
//   device:         1 ............................ 2 ................................ 3
#pragma once

#include <algorithm>
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
#include "ringlet/crossings/crossing_report.h"
#include "ringlet/groom/groom.h"
#include "ringlet/rest/material.h"
#include "ringlet/scene/body.h"
#include "ringlet/scene/force_field.h"
#include "ringlet/scene/head_pose.h"
#include "ringlet/scene/settings.h"
#include "ringlet/scene/strand_cut.h"
#include "ringlet/solver/compute_device.h"
#include "ringlet/solver/hair_asset.h"
#include "ringlet/solver/kernel_choice.h"

namespace ringlet {
namespace gpu {
class Buffer;
}

/// Numerical state of a simulation since it began.
struct SimulationReport {
  double maxEdgeStretch = 0;    // highest ratio of an edge's length to its length in the groom, over all
                                // outer steps; infinite once a number is not finite
  double limitedShare = 0;      // share of edges, over all steps, that the stretch limit changed
  std::uint64_t nonfinite = 0;  // particles whose position or velocity is not finite now
  std::int64_t firstNonfiniteStrand = -1;  // strand (groom order) and particle of the first of them, or -1
  std::int64_t firstNonfiniteParticle = -1;
  double velocityResidual = 0;  // of the velocity solve: |r - L v| relative to |r| plus a step's gravity;
                                // worst strand and step; 0 if not measured
  std::uint64_t degenerateEdges = 0;  // edges (times steps) that had no direction
};

/// Momentum that contacts gave to particles in a step [kg m/s]: the sum, which is 0 except for the error of
/// the iteration, and the sum of the magnitudes.
struct ContactMomentum {
  Vec3d sum{};
  double sizes = 0;
};

/// Counts of contacts. All are 0 without contacts.
struct ContactReport {
  std::uint64_t contactParticles = 0;
  std::uint64_t pairsUnpruned = 0;  // pairs of strands that overlap at rest with enlarged radii
  std::uint64_t pairs = 0;          // of these, pairs that may touch
  std::uint64_t volumeStrands = 0;  // strands in contact as a volume
  std::uint64_t listed = 0;         // pairs of particles in the lists now
  std::uint64_t contacts = 0;   // of these, pairs whose springs push; with the time taper, pairs that touch
                                // or have not faded
  std::uint64_t pairTests = 0;  // pairs of particles tested since the simulation began, over all steps
  std::uint64_t rebuilds = 0;   // of the lists, since the simulation began
  double momentumError = 0;     // of the last step: |sum of contact momenta| over the sum of their magnitudes
  std::uint64_t volumeCut = 0;  // how often a particle's coupling to the volume was cut off, since the
                                // simulation began, because the volume's sums cannot hold more
  double volumeLargest = 0;     // the largest coupling as a share of what the sums can hold; above 1 it was
                                // cut off
  double volumeCoarsest = 0;    // the largest cell of the volume's grid as a multiple of the size asked for
  CrossingReport ways{};        // changed so that no hair goes through hair, since the simulation began
  // The counts that listed, contacts and momentumError are derived from, of the strands that are simulated
  // here; each pair has two sides.
  std::uint64_t listedSides = 0, contactSides = 0;
  ContactMomentum momentum{};

  void derive() {
    listed = listedSides / 2, contacts = contactSides / 2;
    momentumError = momentum.sizes > 0 ? length(momentum.sum) / momentum.sizes : 0;
  }
  /// Adds the report of another part of the same hair (KernelChoice::link).
  void add(const ContactReport& part) {
    listedSides += part.listedSides, contactSides += part.contactSides, pairTests += part.pairTests;
    volumeCut += part.volumeCut, volumeLargest = std::max(volumeLargest, part.volumeLargest);
    volumeCoarsest = std::max(volumeCoarsest, part.volumeCoarsest);
    momentum = {momentum.sum + part.momentum.sum, momentum.sizes + part.momentum.sizes};
    derive();
  }
  /// Sentences for people: where the volume's sums could not hold the hair, and what to do.
  std::vector<std::string> warnings() const;
};

/// A head before its first frame. Members left out mean no motion. The spans are read until create returns.
struct InitialState {
  HeadPose head{};
  std::optional<HeadPose> oneStepEarlier{};  // one outer step before; the hair starts moving with the head
  std::span<const Body> bodies{};            // solids (Integrator::jacobi only)
  std::span<const BodyPose> bodyPlaces{};    // their poses; without, their poses at t = 0
  // Poses of the strands (Simulation::stepFrame), now and one outer step before, in groom order; BodyPose{}
  // where left out. The hair starts at rest relative to them.
  std::span<const BodyPose> roots{}, rootsEarlier{};
  // Displacement of each strand's root (groom order) relative to the head when the head's pose has `shift` 1,
  // in the groom's axes [m]. For scenes that press hair together that is apart at rest.
  std::span<const Vec3d> rootShifts{};
  // Whether each frame copies positions into the host's memory. If not, framePositions() must not be called,
  // and positions() waits and copies.
  bool readsBack = true;
};

/// Positions and velocities of the particles, in groom order, relative to the head's origin and its velocity,
/// along world axes.
struct HairState {
  std::vector<Vec3f> positions;   // [m]
  std::vector<Vec3f> velocities;  // [m/s]
};

/// Positions in device memory, for a host that draws from there (ComputeDevice::adopt): four floats a
/// particle, x y z 0 [m], relative to the head's origin, along world axes. After the wait for a frame they
/// are that frame's. Commands of the host that read them begin with a barrier from compute writes of all
/// memory (VkMemoryBarrier: kernels may write through another VkBuffer of the same memory), and must end
/// before the next frame is submitted. The buffer has the usages storage, uniform texel, vertex and transfer
/// source.
struct DevicePositions {
  void* buffer = nullptr;  // VkBuffer; where handles are 64 bits
  std::uint64_t bytes = 0;
  std::vector<std::uint32_t> particles;  // the groom's index of each particle in the buffer
  const gpu::Buffer* own = nullptr;      // the same buffer, for kernels of Ringlet's
};

/// Message of Simulation::restore for bytes of another simulation.
inline constexpr const char* kForeignCheckpoint =
    "the checkpoint is not of this simulation: it holds another number of bytes";

/// Threads: one at a time; simulations of one device or asset may run on different threads.
///
/// Strands that float32 cannot hold, and a few that would need far more steps than the others, are carried
/// rigidly by their roots, in their rest shape (rest/rigid_strands.h); warnings() names them. They have
/// positions and velocities like other strands, and their places in groom order. Only their roots move them:
/// no body, no contact, not setState. SimulationReport does not count their edges, ContactReport does not
/// count their particles.
class Simulation {
 public:
  /// The hair of an asset on one head. Fails, with advice, on invalid bodies and when the device lacks
  /// memory. Cost: the hair's state in device memory; kernels are compiled with the first simulation that
  /// needs them on a device.
  static Result<Simulation> create(const HairAsset& asset, const InitialState& initial = {});

  /// The same with an asset of its own. Also fails where HairAsset::build fails.
  static Result<Simulation> create(const ComputeDevice& device, const Groom& groom, const Material& material,
                                   const Settings& settings, const InitialState& initial = {},
                                   const KernelChoice& kernel = {});
  Simulation(Simulation&&) noexcept;
  Simulation& operator=(Simulation&&) noexcept;
  ~Simulation();

  /// One frame: settings.stepsPerFrame outer steps; stepPoses[k] is the head's pose at the end of step k. If
  /// the head jumps (Settings::teleportDistance), hair is carried along and does not move relative to the
  /// head in this frame; afterwards it continues its motion. bodyPoses: as bodyPosesOf returns them for these
  /// steps; empty: the head carries all bodies. rootPoses[step * strands + strand], groom order: each
  /// strand's pose in the head's frame at the end of each step, which moves its root particles and its root
  /// frame; empty: roots stay in place on the head.
  /// bodyPoints: of bodies that bend; empty: they keep their shape.
  ///   x_world = head.position + rotate(head.rotation, root.position + rotate(root.rotation, x_groom))
  Status stepFrame(std::span<const HeadPose> stepPoses, std::span<const BodyPose> bodyPoses = {},
                   std::span<const BodyPose> rootPoses = {}, BodyPoints bodyPoints = {});
  /// Frames in flight, with the same bits as stepFrame. submitFrame has the arguments of stepFrame, submits
  /// the frame and returns. waitFrame waits for the oldest frame that was not waited for; framePositions then
  /// returns its positions (as positions() does), until the kFramesInFlight'th frame after it is submitted.
  /// At most kFramesInFlight frames may be submitted and not waited for, and none when stepFrame is called.
  /// All other functions first wait for frames in flight and then report the state after the last one. With
  /// contacts, which may need more memory within a frame, and where the head jumps, submitFrame waits for the
  /// previous frames.
  static constexpr std::size_t kFramesInFlight = 2;
  Status submitFrame(std::span<const HeadPose> stepPoses, std::span<const BodyPose> bodyPoses = {},
                     std::span<const BodyPose> rootPoses = {}, BodyPoints bodyPoints = {});
  Status waitFrame();
  std::vector<Vec3f> framePositions() const;
  /// The same, written into positions of the whole groom; of divided hair only the strands here change.
  void framePositions(std::span<Vec3f> all) const;
  /// The same in place, without a copy, valid as long; not for divided hair.
  std::span<const Vec3f> frameView() const;
  /// stepFrame with poses interpolated from the last one to `end`.
  Status stepFrame(const HeadPose& end);

  /// Positions in groom order [m], relative to the head's origin, along world axes; in the world:
  /// head().position + p.
  Result<std::vector<Vec3f>> positions() const;
  /// The same in device memory, without a copy: a buffer for each chunk of strands, valid as long as the
  /// simulation. Rigid strands are not in them.
  std::vector<DevicePositions> devicePositions() const;
  /// Positions and velocities. setState sets those of strands that are not rigid, and rebuilds contacts.
  Result<HairState> state() const;
  Status setState(const HairState& state);

  /// The state on which later frames depend: hair, contacts, poses of head, bodies and roots, and the counts
  /// of report(). restore() puts it into a simulation created with the same arguments on the same device by
  /// the same program, which then continues with the same bits as if it had stepped all frames itself. The
  /// bytes have a checksum and a fingerprint of the hair (checkpoint_guard.h). Both guard against mistakes
  /// and not against intent: restore only what you would run as a program. Cost: 32 bytes a particle to read
  /// back, and with contacts their lists.
  Result<std::vector<std::byte>> checkpoint();
  /// Fails, without a change, where the bytes are damaged or of other hair.
  Status restore(std::span<const std::byte> checkpoint);

  /// Changes settings from the next frame on. These may change: gravity (the rest pose stays balanced against
  /// the gravity of the asset), maxStretch, teleportDistance, loops and iterations; the number of steps a
  /// frame, up to the asset's, and frames a second, with steps no longer than the asset's; and the settings
  /// of contacts and air that scene/settings_fields.h marks as live. Equal ones are no change. Fails, without
  /// a change, where another setting differs or a value is out of range. Cost: frames are recorded again,
  /// some microseconds a dispatch. With contacts it waits for frames in flight; a change of stiffness or
  /// damping rebuilds their lists.
  Status setSettings(const Settings& settings);
  /// Changes the material from the next frame on: stiffnesses, dampings, blend of the core, variation. Needs
  /// the integrator jacobi. Fails, without a change, where another number differs or a value is out of range.
  /// warnings() are then those of the material. Cost: it waits for frames in flight and gives this head
  /// constants of its own, 32 bytes a particle and 112 a strand; the first change computes the rest state
  /// twice.
  Status setMaterial(const Material& material);
  /// Replaces the bodies, from the next frame on, by any number of others. `places`: their present poses in
  /// the world; without them the bodies are at the head. Fails, without a change, where create fails on
  /// bodies. Cost: it waits for frames in flight, and copies bodies and grids of meshes to the device.
  Status setBodies(std::span<const Body> bodies, std::span<const BodyPose> places = {});
  /// Sets external accelerations of all particles, in groom order [m/s^2], along world axes; they are added
  /// to gravity; each number is from -1e6 to 1e6. They act in every step of frames submitted from now on,
  /// until others are set; initially they are 0. The solve treats them explicitly: a force that pulls towards
  /// a place must not be stiffer than about 1/T^2 a metre, T being the step. Cost: 16 bytes a particle to
  /// write, and to copy in each frame; 68 bytes of memory.
  Status setForces(std::span<const Vec3f> forces);
  /// Pulls particles to places: `places` in groom order, in the groom's axes [m] (the groom itself is its
  /// rest pose), each number from -1e6 to 1e6; head and root poses carry them as they carry roots. Each place
  /// is reached at the end of the next frame submitted, at a constant speed from the place before or, with
  /// `from`, from there; it is held until others are set. `strengths` of every particle, 0 to 1e7: a goal of
  /// strength 1 holds the particle's own weight 1 cm away; initially they are 0. `dampingRatio`, 0 to 1000:
  /// of the particle's motion about its place, critical at 1. The solve treats goals implicitly, so that any
  /// strength is stable. Cost: 32 bytes a particle to write, and to copy in each frame; 136 bytes of memory;
  /// the strand kernel of bodies and air.
  Status setGoals(std::span<const Vec3f> places, std::span<const float> strengths, double dampingRatio = 1,
                  std::span<const Vec3f> from = {});
  /// Replaces the force fields: `fields` are those at the end of the next frame submitted and later, until
  /// others are set. `from`: those at its start, from which they change evenly; empty: they are `fields`
  /// throughout. The solve treats drag implicitly, so that any is stable, and accelerations explicitly: one
  /// that pulls towards a place must not grow by more than about 1/T^2 a metre, T being the step. Fails,
  /// without a change, on a number out of range and on more than kMostForceFields. Cost: the strand kernel of
  /// bodies and air; another number of fields or other grids wait for frames in flight.
  Status setFields(std::span<const ForceField> fields, std::span<const ForceField> from = {});
  /// Adds features to those that this hair uses, as their first use does: waits for frames in flight,
  /// compiles kernels, which takes seconds on some drivers, and makes buffers. For hosts that want to choose
  /// when this happens. Fails, without a change, where the settings do not allow these features. Also fails
  /// where the device lacks memory; then the hair is lost.
  Status prepare(const Features& features);
  /// Cuts strands, from the next frame on. What is kept stays as it was, with the same rest state; the edge
  /// at the cut is removed, and what is cut off falls: bodies, air, fields and other hair in contact pair by
  /// pair act on it, head and goals do not. It keeps its places in groom order. A strand may be cut again,
  /// nearer to its root. Needs the integrator jacobi and no frame in flight. Strands that are carried rigidly
  /// stay whole. Fails, without a change, for a part of hair, where nothing would fall, and where fewer than
  /// two particles would stay, or fewer than follow the head. Checkpoints do not hold cuts: make the same
  /// ones, call by call, before restore(). Cost: a second strand kernel, to compile and to run in each frame
  /// over the strands that are cut.
  Status cut(std::span<const StrandCut> cuts);
  /// The present settings and material; initially the asset's. Checkpoints hold neither them nor bodies,
  /// forces, goals and fields: set these before restore().
  const Settings& settings() const;
  const Material& material() const;

  const HeadPose& head() const;
  Result<SimulationReport> report() const;
  Result<ContactReport> contactReport() const;
  /// Warnings for the user (a core spring capped for this step, gravity preload too large, strands carried
  /// rigidly), a sentence each.
  const std::vector<std::string>& warnings() const;

 private:
  friend class HairFrames;
  friend class Diagnostics;
  struct Implementation;
  explicit Simulation(std::unique_ptr<Implementation>);
  std::unique_ptr<Implementation> self_;
};

}  // namespace ringlet
