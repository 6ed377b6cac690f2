// Hair of a scene on devices: whole on one, or its strands divided among several.
#pragma once

#include <memory>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/run/device_hair.h"
#include "ringlet/run/scene_hair.h"
#include "ringlet/solver/compute_device.h"
#include "ringlet/solver/kernel_choice.h"

namespace ringlet {

/// The rest state of all of the input's hair. Errors: as buildWholeRest.
Result<WholeRest> wholeRestOf(const SceneHairInput& input);

/// One device for each part, at least one; a device may occur twice. Errors: those of the hair; more devices
/// than strands.
Result<std::unique_ptr<SceneHair>> makeDividedHair(const SceneHairInput& input,
                                                   std::vector<DeviceHairChoice> choices);

/// The same with equal kernel options for all. Without devices: on the one that ComputeDevice::open chooses.
HairMaker hairOn(std::vector<ComputeDevice> devices, const KernelChoice& kernel = {});

}  // namespace ringlet
