// The hair of a run on devices, opened as the program does.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "program/device/compile_note.h"
#include "program/device/device_choice.h"
#include "program/device/tuned_shapes.h"
#include "ringlet/base/result.h"
#include "ringlet/run/device_hair.h"
#include "ringlet/run/scene_hair.h"
#include "ringlet/solver/compute_device.h"

namespace ringlet::program {

/// As ComputeDevice::open, with the program's cache of kernels.
Result<ComputeDevice> openGpu(const std::string& device);

/// What a run's hair is made from on one device, with the measurements of `ringlet tune` for hair alone.
/// `isTold`: print notes on standard error if kernels take long to compile or should be tuned again.
class GpuChoice {
 public:
  static Result<std::unique_ptr<GpuChoice>> make(const SceneHairInput& input, const DeviceChoice& choice,
                                                 const std::string& device, bool isTold);
  /// Refers to this.
  const DeviceHairChoice& choice() const { return *choice_; }

 private:
  GpuChoice() = default;
  TunedShapes tuned_;
  std::unique_ptr<CompileNote> note_;
  std::optional<DeviceHairChoice> choice_;
};

/// Errors: those of the devices and of the hair; more devices than strands.
Result<std::unique_ptr<SceneHair>> makeGpuHair(const SceneHairInput& input, const DeviceChoice& choice,
                                               bool isTold);

}  // namespace ringlet::program
