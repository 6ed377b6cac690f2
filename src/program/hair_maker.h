// The hair of a run, as its options say: on a device, divided among several or among ranks, or by the
// reference.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "program/compile_note.h"
#include "program/simulate_run.h"
#include "program/tuned_shapes.h"
#include "ringlet/base/result.h"
#include "ringlet/run/device_hair.h"
#include "ringlet/run/scene_hair.h"
#include "ringlet/solver/compute_device.h"

namespace ringlet::program {

/// As ComputeDevice::open, with the program's cache of kernels.
Result<ComputeDevice> openGpu(const std::string& device);

/// Errors: those of the device and of the hair; more devices than strands.
Result<std::unique_ptr<SceneHair>> makeHair(const SceneHairInput& input, const SimulateOptions& options);

/// What a run's hair is made of on one device, with what `ringlet tune` remembered, for hair alone. Tells on
/// standard error where kernels take long to compile, or want tuning again, unless the options are quiet.
class GpuChoice {
 public:
  static Result<std::unique_ptr<GpuChoice>> make(const SceneHairInput& input, const SimulateOptions& options,
                                                 const std::string& device);
  /// Refers to this.
  const DeviceHairChoice& choice() const { return *choice_; }

 private:
  GpuChoice() = default;
  TunedShapes tuned_;
  std::unique_ptr<CompileNote> note_;
  std::optional<DeviceHairChoice> choice_;
};

/// The reference in double precision, on one thread. Refuses what the solver refuses, and warns of what it
/// warns of.
Result<std::unique_ptr<SceneHair>> makeReferenceHair(const SceneHairInput& input);

}  // namespace ringlet::program
