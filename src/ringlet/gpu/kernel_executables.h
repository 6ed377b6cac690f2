// A driver's statistics of the machine code of a kernel (VK_KHR_pipeline_executable_properties).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/gpu/kernel.h"

namespace ringlet::gpu {

/// As the driver names and counts it: "VGPRs", "Spilled VGPRs", "Code size", ...
struct KernelStatistic {
  std::string name;
  double value = 0;
};

struct KernelExecutable {
  std::string name;
  std::uint32_t subgroupSize = 0;  // that the driver compiled it for
  std::vector<KernelStatistic> statistics;
};

/// One or several a kernel; with statistics where the device was opened with Inspection::statistics. Empty
/// where the device does not tell (DeviceProperties::inspection).
Result<std::vector<KernelExecutable>> executablesOf(const Kernel& kernel);

}  // namespace ringlet::gpu
