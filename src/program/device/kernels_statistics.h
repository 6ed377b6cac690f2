// What drivers call their statistics of a kernel's machine code, and what of it a person should see.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "ringlet/gpu/kernel_executables.h"

namespace ringlet::program {

/// `spills`, `1 wave`: see `ringlet kernels --help`.
std::vector<std::string> flagsOf(std::span<const gpu::KernelStatistic> statistics);

/// Of the statistics what is worth a line of text.
std::string statisticsText(std::span<const gpu::KernelStatistic> statistics);

}  // namespace ringlet::program
