// Backend: the solver that `ringlet simulate` uses, on the GPU or the CPU reference. Thin: both are
// complete simulations already, and this only gives them one face.
#pragma once

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
#include "ringlet/solver/simulation.h"

namespace ringlet::program {

/// What a simulation starts from.
struct BackendInput {
  const Groom& groom;
  const Material& material;
  const Settings& settings;
  HeadPose start, oneStepEarlier;
  std::span<const Vec3d> rootShifts;  // of each strand's root beside the head (HeadPose::shift) [m], or none
  std::span<const Body> bodies;
  std::span<const BodyPose> bodyStarts;  // where they are before the first step
  // Of each strand in the head's frame, before the first step and one step earlier; none: the head carries
  // them.
  std::span<const BodyPose> rootStarts, rootsEarlier;
  const std::vector<StrandGeometry>* geometry = nullptr;  // as KernelChoice::geometry
};

class Backend {
 public:
  virtual ~Backend() = default;

  /// Frames in flight, as Simulation has them (kFramesInFlight, and until when framePositions may be asked);
  /// the reference computes at once. stepPoses[k] is the head's pose at the end of step k, bodyPoses what
  /// bodyPosesOf gives for these steps, rootPoses what Simulation::stepFrame takes.
  virtual Status submitFrame(std::span<const HeadPose> stepPoses, std::span<const BodyPose> bodyPoses,
                             std::span<const BodyPose> rootPoses) = 0;
  virtual Status waitFrame() = 0;
  /// As Simulation::setSettings and setMaterial, from the next frame on; no frame is in flight. keysAt: the
  /// time whose keys give these numbers [s]; a process that has the same scene finds them by it.
  virtual Status change(const Settings& settings, const Material& material, double keysAt) = 0;
  /// As the ones of Simulation, for the next frame.
  virtual Status setFields(std::span<const ForceField> fields, std::span<const ForceField> from) = 0;
  virtual Status setGoals(std::span<const Vec3f> places, std::span<const float> strengths,
                          double dampingRatio, std::span<const Vec3f> from) = 0;
  /// As Simulation::cut; the caller has checked what each cut keeps. Errors: where hair is divided.
  virtual Status cut(std::span<const StrandCut> /*cuts*/) {
    return Error{"hair that is divided among devices is not cut; use one device"};
  }
  /// Of the frame waited for last. Groom order, relative to the head's origin, along world axes [m].
  /// Into the groom's positions; of divided hair those of its own strands.
  virtual void framePositions(std::span<Vec3f> all) = 0;
  /// The same of now, before the first frame too, and no frame in flight.
  virtual Result<std::vector<Vec3f>> positions() = 0;
  /// As Simulation::checkpoint and restore.
  virtual Result<std::vector<std::byte>> checkpoint() = 0;
  virtual Status restore(std::span<const std::byte> checkpoint) = 0;
  virtual Result<SimulationReport> report() = 0;
  virtual Result<ContactReport> contactReport() = 0;
  /// By stage of computing, summed over all frames waited for [ms].
  virtual std::map<std::string, double> stageMilliseconds() const = 0;
  /// Whether these can be asked for after every frame; not where that is a message.
  virtual bool tellsTimesOfFrames() const { return true; }
  /// What the host spent on the device, summed likewise; none without a device, or with several.
  virtual std::optional<HostMilliseconds> hostMilliseconds() const { return {}; }
  /// Number of strands that are carried rigidly (rest/rigid_strands.h).
  virtual std::size_t rigidStrandCount() const = 0;
  /// Of the hair and its settings; and of the device: its own watchers', its tuned shapes where they cannot
  /// be read.
  virtual std::vector<std::string> warnings() const = 0;
  virtual std::vector<std::string> deviceMessages() const = 0;

  virtual std::string device() const = 0;
  virtual std::string driver() const = 0;
  virtual std::string kernel() const = 0;
  /// Of divided hair: the strands of this process, groom order.
  virtual std::vector<std::uint32_t> ownStrands() const { return {}; }
  /// Whether measurements of `ringlet tune` chose the shapes.
  virtual bool isTuned() const { return false; }
  /// Time of compiling its kernels [ms]; 0 if there are none to compile.
  virtual double compileMilliseconds() const { return 0; }
  /// Size of its buffers on the device; none without a device.
  virtual std::optional<std::uint64_t> deviceBytes() const = 0;
};

/// Where and how the GPU's solver runs.
struct GpuChoice {
  std::string device;                   // see ComputeDevice::open
  std::optional<ComputeDevice> opened;  // in its place
  KernelChoice kernel;
  bool usesTuned = true;  // what `ringlet tune` remembered, for hair alone
  bool tells = true;      // a line on standard error where kernels take long to compile, or want tuning again
};

/// As ComputeDevice::open, with the program's cache of kernels.
Result<ComputeDevice> openGpu(const std::string& device);

/// The Vulkan solver.
Result<std::unique_ptr<Backend>> makeGpuBackend(const BackendInput& input, const GpuChoice& gpu);

/// The same with the groom's strands on several devices, each named as GpuChoice::device is; one may be named
/// twice. Errors: what HairAsset::build says of hair that cannot be divided; more devices than strands.
Result<std::unique_ptr<Backend>> makeSplitBackend(const BackendInput& input, const GpuChoice& gpu,
                                                  std::span<const std::string> devices);

/// The same with a part on each rank (ranks.h), which has one of these devices, in turn, or gpu.device. On
/// rank 0 all of the hair; on another its own part.
Result<std::unique_ptr<Backend>> makeRankBackend(const BackendInput& input, const GpuChoice& gpu,
                                                 std::span<const std::string> devices);

/// The reference in double precision, on one thread. Refuses what the solver refuses, and warns of what it
/// warns of.
Result<std::unique_ptr<Backend>> makeReferenceBackend(const BackendInput& input);

}  // namespace ringlet::program
