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

/// Of all of the input's hair. Errors: as buildWholeRest.
Result<WholeRest> wholeRestOf(const SceneHairInput& input);

/// A device each, at least one; one may be there twice. Errors: those of the hair; more devices than strands.
Result<std::unique_ptr<SceneHair>> makeDividedHair(const SceneHairInput& input,
                                                   std::vector<DeviceHairChoice> choices);

/// The same with one kind of kernels. Without devices: on the one that ComputeDevice::open takes.
HairMaker hairOn(std::vector<ComputeDevice> devices, const KernelChoice& kernel = {});

}  // namespace ringlet
