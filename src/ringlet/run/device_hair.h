// DeviceHair: a scene's hair on one device.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/run/scene_hair.h"
#include "ringlet/solver/compute_device.h"
#include "ringlet/solver/kernel_choice.h"

namespace ringlet {

struct DeviceHairChoice {
  ComputeDevice device;
  KernelChoice kernel{};                // with what the scene needs besides
  std::vector<std::string> messages{};  // of the device, that facts() say before its own
};

/// Errors: those of Simulation::create.
Result<std::unique_ptr<SceneHair>> makeDeviceHair(const SceneHairInput& input, DeviceHairChoice choice);

}  // namespace ringlet
