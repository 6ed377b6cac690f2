// Devices as Python holds them.
#pragma once

#include <memory>

#include "python/binding.h"
#include "ringlet/solver/compute_device.h"

namespace ringlet::python {

struct DeviceObject {
  ComputeDevice device;
};
using DeviceHandle = std::shared_ptr<DeviceObject>;

}  // namespace ringlet::python
