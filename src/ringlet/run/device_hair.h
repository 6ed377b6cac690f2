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
  KernelChoice kernel{};                // the scene's features are added
  std::vector<std::string> messages{};  // about the device; facts() puts them before its own
};

/// The scene's hair at the start of its first frame. Errors: those of Simulation::create.
Result<Simulation> makeSimulation(const SceneHairInput& input, DeviceHairChoice choice);
/// The same as the SceneHair of a run.
Result<std::unique_ptr<SceneHair>> makeDeviceHair(const SceneHairInput& input, DeviceHairChoice choice);

}  // namespace ringlet
