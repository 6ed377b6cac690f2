// One kernel compiled in a process of its own: drivers crash in their own statistics.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "program/device/kernels_list.h"
#include "ringlet/base/result.h"
#include "ringlet/gpu/device.h"
#include "ringlet/gpu/kernel_executables.h"

namespace ringlet::program {

/// What became of a kernel.
struct CompiledKernel {
  bool isCompiled = false;
  std::string trouble{};                  // why not; or that the driver crashed in its statistics
  std::optional<std::uint32_t> subgroup;  // none: the driver's choice, which it does not tell
  double seconds = 0;                     // to compile
  std::vector<gpu::KernelStatistic> statistics{};
};

/// In this process, on a device opened for it.
CompiledKernel compileKernel(const ComputeDevice& device, const ListedKernel& kernel);

/// The child's end: prints what compileKernel returns as one line.
void printCompiled(const CompiledKernel& compiled);

/// The parent's end: runs this program again with these arguments and reads that line. A child that dies is a
/// kernel that is not compiled, and says by which signal.
CompiledKernel compileInChild(const std::vector<std::string>& arguments);

}  // namespace ringlet::program
