// DeviceHair: a scene's hair on one device.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/run/scene_hair.h"
#include "ringlet/solver/compute_device.h"
#include "ringlet/solver/kernel_choice.h"
#include "ringlet/solver/simulation.h"

namespace ringlet {

struct DeviceHairChoice {
  ComputeDevice device;
  KernelChoice kernel{};                // with what the scene needs besides
  std::vector<std::string> messages{};  // of the device, that facts() say before its own
};

/// The scene's hair where its first frame begins. Errors: those of Simulation::create.
Result<Simulation> makeSimulation(const SceneHairInput& input, DeviceHairChoice choice);
/// The same for a run.
Result<std::unique_ptr<SceneHair>> makeDeviceHair(const SceneHairInput& input, DeviceHairChoice choice);

}  // namespace ringlet
