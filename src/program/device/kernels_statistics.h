// The statistics that drivers give for a kernel's machine code, and which of them are worth showing.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "ringlet/gpu/kernel_executables.h"

namespace ringlet::program {

/// `spills`, `1 wave`: see `ringlet kernels --help`.
std::vector<std::string> flagsOf(std::span<const gpu::KernelStatistic> statistics);

/// The statistics that are worth showing, as a line of text.
std::string statisticsText(std::span<const gpu::KernelStatistic> statistics);

}  // namespace ringlet::program
